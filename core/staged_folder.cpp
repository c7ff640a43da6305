#include "antigrasp/core/staged_folder.h"

#include <unistd.h>

#include <string>
#include <system_error>
#include <utility>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/error.h"

namespace antigrasp {

namespace fs = std::filesystem;

StagedFolder::StagedFolder(fs::path folder)
    : folder_(std::move(folder)),
      path_(folder_ / ("." + std::to_string(::getpid()) + ".tmp")),
      made_(!fs::exists(folder_)) {
  MakeFolder(folder_);
  std::error_code ignored;
  fs::remove_all(path_, ignored);  // of a process of that number that was killed
  MakeFolder(path_);
}

StagedFolder::~StagedFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
  if (made_) fs::remove(folder_, ignored);  // only an empty one goes
}

void StagedFolder::Commit() {
  for (const auto& entry : fs::directory_iterator(path_)) {
    std::error_code error;
    fs::rename(entry.path(), folder_ / entry.path().filename(), error);
    if (error) {
      throw RuntimeFailure("cannot write " + (folder_ / entry.path().filename()).string() + ": " +
                           error.message());
    }
  }
}

}  // namespace antigrasp
