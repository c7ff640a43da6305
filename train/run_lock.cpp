#include "antigrasp/train/run_lock.h"

#include <spdlog/spdlog.h>
#include <unistd.h>

#include "antigrasp/core/atomic_file.h"

namespace antigrasp {
namespace {

namespace fs = std::filesystem;

// Only in folders of the run itself, whatever else lies beside them.
void RemoveLeavings(const RunFolder& run) {
  int count = 0;
  for (const fs::path& folder : {run.root, run.Stl(), run.Events().parent_path()}) {
    count += RemoveAbandonedFiles(folder);
  }
  for (const fs::path& folder : run.Episodes()) count += RemoveAbandonedFiles(folder);
  if (count > 0) spdlog::info("removed {} unfinished files of a process that was killed", count);
}

}  // namespace

RunLock::RunLock(const RunFolder& run) {
  if (!fs::is_directory(run.root)) {  // a file in its place is refused
    MakeFolder(run.root);
    made_ = run.root;
  }
  lock_.emplace(run.root, "trains this run");
  if (!lock_->held() && ::access(run.root.c_str(), W_OK) == 0) {
    spdlog::warn(
        "no locks on the file system of {}: two processes there would not notice each other",
        run.root.string());
  }
  RemoveLeavings(run);
}

RunLock::~RunLock() {
  lock_.reset();
  std::error_code ignored;
  if (!made_.empty()) fs::remove(made_, ignored);  // refused when there is anything in it
}

}  // namespace antigrasp
