#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "antigrasp/core/file_lock.h"

namespace antigrasp {

// Files that appear in a folder together: write them into path(), a hidden folder in it, in folders
// of their own if need be, and Commit() moves them. Without it they are removed again and the
// folder is as it was. What a killed process had staged there is removed by the next one, where
// there are locks.
class StagedFolder {
 public:
  // Makes the folder (and parents) where it is missing: InputError as MakeFolder.
  explicit StagedFolder(std::filesystem::path folder);
  ~StagedFolder();
  StagedFolder(const StagedFolder&) = delete;
  StagedFolder& operator=(const StagedFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  // The file or folder of this name is moved when all others are. RuntimeFailure when one cannot
  // be.
  void Commit(const std::string& last = "");

 private:
  std::filesystem::path folder_, path_;
  bool made_;                     // the folder was not there before
  std::optional<FileLock> lock_;  // on a file in path_, as long as it is used
};

}  // namespace antigrasp
