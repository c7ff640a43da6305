#include "antigrasp/core/file_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

namespace antigrasp {

FileLock::FileLock(std::filesystem::path path, Missing missing) : path_(std::move(path)) {
  while (Open(missing)) {
    if (::flock(file_, LOCK_EX | LOCK_NB) != 0) {
      if (errno == EINTR) continue;
      if (errno == EWOULDBLOCK) {
        state_ = State::kTaken;
      } else if (struct stat now{};
                 missing == Missing::kCreate && ::fstat(file_, &now) == 0 && now.st_size == 0) {
        ::unlink(path_.c_str());  // made by us for nothing: no locks here
      }
      Close();
      return;
    }
    if (IsStillThere()) {
      state_ = State::kHeld;
      return;
    }
    // Its holder removed it while we waited to get in: there is a new one, or none.
  }
}

FileLock::~FileLock() { Close(); }

bool FileLock::Open(Missing missing) {
  Close();
  const int create = missing == Missing::kCreate ? O_CREAT : 0;
  file_ = ::open(path_.c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW | create, 0666);
  // The file of another user can be locked, too.
  if (file_ < 0 && errno == EACCES) {
    file_ = ::open(path_.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW);
  }
  return file_ >= 0;
}

bool FileLock::IsStillThere() const {
  struct stat ours {
  }, there{};
  return ::fstat(file_, &ours) == 0 && ::lstat(path_.c_str(), &there) == 0 &&
         ours.st_ino == there.st_ino && ours.st_dev == there.st_dev;
}

void FileLock::Close() {
  if (file_ >= 0) ::close(std::exchange(file_, -1));
}

bool FileLock::Write(const std::string& text) {
  const auto size = static_cast<off_t>(text.size());
  return ::pwrite(file_, text.data(), text.size(), 0) == size && ::ftruncate(file_, size) == 0;
}

void FileLock::RemoveFile() { ::unlink(path_.c_str()); }

}  // namespace antigrasp
