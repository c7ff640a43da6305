#include "antigrasp/datasets/mesh_folder.h"

#include <algorithm>
#include <system_error>

#include "antigrasp/core/error.h"
#include "antigrasp/mesh/mesh_file.h"

namespace antigrasp {

namespace fs = std::filesystem;

std::vector<fs::path> MeshFilesIn(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  fs::recursive_directory_iterator it(folder, fs::directory_options::skip_permission_denied, error);
  for (; !error && it != fs::recursive_directory_iterator(); it.increment(error)) {
    std::error_code ignored;
    if (it->is_regular_file(ignored) && IsMeshFile(it->path())) files.push_back(it->path());
  }
  if (error) {
    throw InputError("cannot search: " + error.message(), folder.string(), "a readable folder");
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace antigrasp
