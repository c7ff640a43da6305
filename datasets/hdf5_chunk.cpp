#include "antigrasp/datasets/hdf5_chunk.h"

namespace antigrasp {

bool ItemIsStored(const Hdf5Handle& dataset, const std::vector<hsize_t>& start,
                  const std::vector<hsize_t>& extents) {
  const Hdf5Handle properties(H5Dget_create_plist(dataset.get()), H5Pclose);
  std::vector<hsize_t> chunk(extents.size());
  const int rank = static_cast<int>(chunk.size());
  if (H5Pget_layout(properties.get()) != H5D_CHUNKED ||
      H5Pget_chunk(properties.get(), rank, chunk.data()) != rank || chunk != extents) {
    return true;
  }
  unsigned passed_by = 0;
  haddr_t address = HADDR_UNDEF;
  hsize_t stored = 0;
  return H5Dget_chunk_info_by_coord(dataset.get(), start.data(), &passed_by, &address, &stored) >=
             0 &&
         address != HADDR_UNDEF && passed_by == 0;
}

}  // namespace antigrasp
