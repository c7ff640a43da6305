#pragma once

#include <filesystem>
#include <string>

namespace antigrasp {

// An exclusive lock on a file (flock). The system lets go of it when the process ends, however that
// happens: a killed holder blocks nobody. Processes of one computer exclude each other, over NFS
// those of all its computers. Reading, writing and renaming the file need no lock and go on.
class FileLock {
 public:
  enum class State {
    kHeld,
    kTaken,  // by another FileLock, here or elsewhere
    kNone    // no file to lock, or a file system without locks
  };
  enum class Missing { kCreate, kLeave };  // a file that is not there

  // Does not wait.
  explicit FileLock(std::filesystem::path path, Missing missing = Missing::kCreate);
  ~FileLock();  // the file stays
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

  State state() const { return state_; }
  bool held() const { return state_ == State::kHeld; }

  // Of the holder. Write replaces what is in the file; false where the disk refuses.
  bool Write(const std::string& text);
  void RemoveFile();

 private:
  bool Open(Missing missing);
  bool IsStillThere() const;
  void Close();

  std::filesystem::path path_;
  int file_ = -1;
  State state_ = State::kNone;
};

}  // namespace antigrasp
