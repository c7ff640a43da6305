#include "antigrasp/datasets/mesh_folder.h"

#include <algorithm>
#include <system_error>

#include "antigrasp/core/error.h"
#include "antigrasp/datasets/shape_format.h"
#include "antigrasp/mesh/mesh_file.h"

namespace antigrasp {
namespace {

namespace fs = std::filesystem;

template <typename Wanted>
std::vector<fs::path> FilesIn(const fs::path& folder, const Wanted& wanted) {
  std::vector<fs::path> files;
  std::error_code error;
  fs::recursive_directory_iterator it(folder, fs::directory_options::skip_permission_denied, error);
  for (; !error && it != fs::recursive_directory_iterator(); it.increment(error)) {
    std::error_code ignored;
    if (it->is_regular_file(ignored) && wanted(it->path())) files.push_back(it->path());
  }
  if (error) {
    throw InputError("cannot search: " + error.message(), folder.string(), "a readable folder");
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

std::vector<fs::path> MeshFilesIn(const fs::path& folder) { return FilesIn(folder, IsMeshFile); }

std::vector<fs::path> GridFilesIn(const fs::path& folder) {
  return FilesIn(
      folder, [](const fs::path& path) { return ShapeFormatByName(path) != ShapeFormat::kHdf5; });
}

}  // namespace antigrasp
