#include "antigrasp/datasets/hdf5_chunk.h"

#include <cstdint>
#include <functional>
#include <numeric>

namespace antigrasp {
namespace {

// Bytes of a chunk before its filters.
hsize_t PlainBytes(const Hdf5Handle& dataset, const std::vector<hsize_t>& extents) {
  const Hdf5Handle type(H5Dget_type(dataset.get()), H5Tclose);
  return std::accumulate(extents.begin(), extents.end(), hsize_t{H5Tget_size(type.get())},
                         std::multiplies<>());
}

// The one question about a chunk's filters that the library answers by a search of its index, and
// not by a walk through it, is for the stored bytes themselves.
bool PassedThroughFilters(const Hdf5Handle& dataset, const std::vector<hsize_t>& start,
                          hsize_t plain_bytes) {
  constexpr hsize_t kHeaders = 4096;  // what filters add to bytes that they cannot shrink
  constexpr hsize_t kCheckSum = 4;    // the library takes it off whatever is left of a chunk
  hsize_t stored = 0;
  if (H5Dget_chunk_storage_size(dataset.get(), start.data(), &stored) < 0 || stored < kCheckSum ||
      stored > 2 * plain_bytes + kHeaders) {
    return false;
  }
  std::vector<unsigned char> bytes(stored);
  std::uint32_t passed_by = 0;
  return H5Dread_chunk(dataset.get(), H5P_DEFAULT, start.data(), &passed_by, bytes.data()) >= 0 &&
         passed_by == 0;
}

// Without filters the library tells no size before it reads, whatever the index claims.
bool LiesInFull(const Hdf5Handle& dataset, const std::vector<hsize_t>& start, hsize_t plain_bytes) {
  unsigned passed_by = 0;
  haddr_t address = HADDR_UNDEF;
  hsize_t stored = 0;
  return H5Dget_chunk_info_by_coord(dataset.get(), start.data(), &passed_by, &address, &stored) >=
             0 &&
         address != HADDR_UNDEF && stored == plain_bytes;
}

}  // namespace

bool ItemIsStored(const Hdf5Handle& dataset, const std::vector<hsize_t>& start,
                  const std::vector<hsize_t>& extents) {
  const Hdf5Handle properties(H5Dget_create_plist(dataset.get()), H5Pclose);
  std::vector<hsize_t> chunk(extents.size());
  const int rank = static_cast<int>(chunk.size());
  if (H5Pget_layout(properties.get()) != H5D_CHUNKED ||
      H5Pget_chunk(properties.get(), rank, chunk.data()) != rank || chunk != extents) {
    return true;
  }
  const hsize_t plain_bytes = PlainBytes(dataset, extents);
  return H5Pget_nfilters(properties.get()) > 0 ? PassedThroughFilters(dataset, start, plain_bytes)
                                               : LiesInFull(dataset, start, plain_bytes);
}

}  // namespace antigrasp
