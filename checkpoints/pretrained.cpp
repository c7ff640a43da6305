#include "antigrasp/checkpoints/pretrained.h"

#include <algorithm>

#include "antigrasp/core/error.h"

namespace antigrasp {
namespace {

namespace fs = std::filesystem;

// Beside the installed program, or in the sources it was built from.
std::vector<fs::path> Folders() {
  std::vector<fs::path> folders;
  std::error_code none;
  const fs::path program = fs::read_symlink("/proc/self/exe", none);
  if (!none) folders.push_back(program.parent_path().parent_path() / "share/antigrasp/pretrained");
  folders.emplace_back(ANTIGRASP_PRETRAINED);
  return folders;
}

}  // namespace

std::vector<std::string> PretrainedNames() {
  std::vector<std::string> names;
  for (const fs::path& folder : Folders()) {
    std::error_code none;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, none)) {
      if (entry.path().extension() == ".pt") names.push_back(entry.path().stem().string());
    }
  }
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

fs::path FindNetworks(const std::string& path_or_name) {
  if (fs::is_directory(path_or_name)) return fs::path(path_or_name) / "checkpoint.pt";
  if (fs::exists(path_or_name)) return path_or_name;
  for (const fs::path& folder : Folders()) {
    const fs::path file = folder / (path_or_name + ".pt");
    if (fs::is_regular_file(file)) return file;
  }
  std::string names;
  for (const std::string& name : PretrainedNames()) names += (names.empty() ? "" : ", ") + name;
  throw InputError("no such networks", path_or_name,
                   names.empty() ? "a checkpoint or the folder of a run"
                                 : "a checkpoint, the folder of a run, or one of: " + names);
}

}  // namespace antigrasp
