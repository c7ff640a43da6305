#include "antigrasp/datasets/hdf5_damage.h"

#include "antigrasp/core/file_kind.h"
#include "antigrasp/datasets/hdf5_handle.h"
#include "antigrasp/datasets/hdf5_lock.h"

namespace antigrasp {
namespace {

constexpr std::uintmax_t kLongestHeader = 96;  // of versions 0 and 1; later ones are shorter

}  // namespace

bool IsTruncatedHdf5(const std::filesystem::path& path) {
  if (!IsHdf5(path)) return false;
  const Hdf5Lock lock;  // also for what the library tells of its last failure
  if (Hdf5Handle(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose)) return false;
  bool truncated = false;
  const auto look = [](unsigned, const H5E_error2_t* error, void* found) -> herr_t {
    if (error->min_num == H5E_TRUNCATED) *static_cast<bool*>(found) = true;
    return 0;
  };
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, look, &truncated);
  std::error_code ignored;
  return truncated || std::filesystem::file_size(path, ignored) < kLongestHeader;
}

}  // namespace antigrasp
