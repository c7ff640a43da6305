#include "antigrasp/checkpoints/pretrained.h"

#include <algorithm>
#include <cstdlib>

#include "antigrasp/core/error.h"

namespace antigrasp {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> Folders(const fs::path& first) {
  std::vector<fs::path> folders;
  if (!first.empty()) folders.push_back(first);
  const char* const named = std::getenv("ANTIGRASP_PRETRAINED");
  if (named != nullptr && *named != '\0') folders.emplace_back(named);
  folders.emplace_back(ANTIGRASP_PRETRAINED_INSTALLED);
  folders.emplace_back(ANTIGRASP_PRETRAINED_SOURCES);
  return folders;
}

}  // namespace

std::vector<std::string> PretrainedNames(const fs::path& first) {
  std::vector<std::string> names;
  for (const fs::path& folder : Folders(first)) {
    std::error_code none;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, none)) {
      if (entry.path().extension() == ".pt") names.push_back(entry.path().stem().string());
    }
  }
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

fs::path FindNetworks(const std::string& path_or_name, const fs::path& first) {
  if (fs::is_directory(path_or_name)) return fs::path(path_or_name) / "checkpoint.pt";
  if (fs::exists(path_or_name)) return path_or_name;
  for (const fs::path& folder : Folders(first)) {
    const fs::path file = folder / (path_or_name + ".pt");
    if (fs::is_regular_file(file)) return file;
  }
  std::string names;
  for (const std::string& name : PretrainedNames(first))
    names += (names.empty() ? "" : ", ") + name;
  throw InputError("no such networks", path_or_name,
                   names.empty() ? "a checkpoint or the folder of a run"
                                 : "a checkpoint, the folder of a run, or one of: " + names);
}

}  // namespace antigrasp
