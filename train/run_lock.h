#pragma once

#include <filesystem>
#include <optional>

#include "antigrasp/core/folder_lock.h"
#include "antigrasp/train/run_folder.h"

namespace antigrasp {

// The right to write to a run's folder, of one process at a time. Making it removes what writers of
// the run that were killed left there. Where there are no locks a warning says so.
class RunLock {
 public:
  // Makes the folder. InputError: another process trains the run, or no folder can be made.
  explicit RunLock(const RunFolder& run);
  ~RunLock();  // a folder that was made and got no files goes again

 private:
  std::filesystem::path made_;  // "": it was there
  std::optional<FolderLock> lock_;
};

}  // namespace antigrasp
