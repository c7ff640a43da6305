#include "antigrasp/core/staged_folder.h"

#include <unistd.h>

#include <regex>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/error.h"

namespace antigrasp {

namespace fs = std::filesystem;

namespace {

constexpr const char* kLock = ".lock";

// Nobody gives such a name to a folder of their own.
bool IsStaged(const fs::path& path) {
  static const std::regex pattern(R"(\.antigrasp-[0-9]+\.tmp)");
  return std::regex_match(path.filename().string(), pattern);
}

void RemoveAbandoned(const fs::path& folder) {
  std::vector<fs::path> abandoned;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.symlink_status().type() != fs::file_type::directory || !IsStaged(entry.path())) {
      continue;
    }
    const FileLock lock(entry.path() / kLock, FileLock::Missing::kLeave);
    if (lock.held()) abandoned.push_back(entry.path());
  }
  std::error_code ignored;
  for (const fs::path& path : abandoned) fs::remove_all(path, ignored);
}

// A folder is moved file by file: there may be one of its name with files of others.
void Move(const fs::path& from, const fs::path& to) {
  if (fs::is_directory(from)) {
    MakeFolder(to);
    for (const auto& entry : fs::directory_iterator(from)) {
      Move(entry.path(), to / entry.path().filename());
    }
    return;
  }
  std::error_code error;
  fs::rename(from, to, error);
  if (error) throw RuntimeFailure("cannot write " + to.string() + ": " + error.message());
}

}  // namespace

StagedFolder::StagedFolder(fs::path folder)
    : folder_(std::move(folder)), made_(!fs::exists(folder_)) {
  MakeFolder(folder_);
  RemoveAbandoned(folder_);
  for (int number = ::getpid(); path_.empty() || fs::exists(path_); ++number) {
    path_ = folder_ / (".antigrasp-" + std::to_string(number) + ".tmp");
  }
  MakeFolder(path_);
  lock_.emplace(path_ / kLock);
}

StagedFolder::~StagedFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
  if (made_) fs::remove(folder_, ignored);  // only an empty one goes
}

void StagedFolder::Commit(const std::string& last) {
  for (const auto& entry : fs::directory_iterator(path_)) {
    const fs::path name = entry.path().filename();
    if (name != kLock && name != last) Move(entry.path(), folder_ / name);
  }
  if (!last.empty()) Move(path_ / last, folder_ / last);
}

}  // namespace antigrasp
