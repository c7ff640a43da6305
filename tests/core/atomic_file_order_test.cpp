// The order of the system calls of one write, seen by standing in for the C library's functions:
// the linker prefers the definitions of the program to those of the libraries.
#include <dlfcn.h>
#include <gtest/gtest.h>
#include <sys/uio.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/error.h"
#include "tests/support/temp_folder.h"

namespace {

namespace fs = std::filesystem;

// What is recorded, while a test listens: calls on files in `folder` and on the folder itself.
struct Listener {
  fs::path folder;
  bool refuse_sync = false;
  std::vector<std::string> calls;

  std::string NameOf(fs::path file) const {
    // Open files that are removed.
    const std::string gone = " (deleted)", path = file.string();
    if (path.ends_with(gone)) file = path.substr(0, path.size() - gone.size());
    if (file == folder) return "folder";
    if (file.parent_path() != folder) return "";
    return file.extension() == ".tmp" ? "temporary" : file.filename().string();
  }
};
Listener* listener = nullptr;

template <typename Function>
Function* Next(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

// True when the call is one of those listened for.
bool Record(const std::string& call, int fd) {
  if (listener == nullptr) return false;
  std::error_code ignored;
  const std::string name =
      listener->NameOf(fs::read_symlink("/proc/self/fd/" + std::to_string(fd), ignored));
  if (name.empty()) return false;
  const std::string text = call + " " + name;
  // Long files are written in pieces.
  const bool again = call == "write" && !listener->calls.empty() && listener->calls.back() == text;
  if (!again) listener->calls.push_back(text);
  return true;
}

int Sync(const char* name, int fd) {
  if (Record("sync", fd) && listener->refuse_sync) {
    errno = EIO;
    return -1;
  }
  return Next<int(int)>(name)(fd);
}

}  // namespace

extern "C" {

ssize_t write(int fd, const void* bytes, size_t count) {
  static auto* const next = Next<ssize_t(int, const void*, size_t)>("write");
  Record("write", fd);
  return next(fd, bytes, count);
}

ssize_t writev(int fd, const iovec* parts, int count) {
  static auto* const next = Next<ssize_t(int, const iovec*, int)>("writev");
  Record("write", fd);
  return next(fd, parts, count);
}

int fsync(int fd) { return Sync("fsync", fd); }
int fdatasync(int fd) { return Sync("fdatasync", fd); }

int close(int fd) {
  static auto* const next = Next<int(int)>("close");
  Record("close", fd);
  return next(fd);
}

int fclose(FILE* file) {
  static auto* const next = Next<int(FILE*)>("fclose");
  Record("close", fileno(file));
  return next(file);
}

int rename(const char* from, const char* to) noexcept {
  static auto* const next = Next<int(const char*, const char*)>("rename");
  if (listener != nullptr) {
    listener->calls.push_back("rename " + listener->NameOf(from) + " to " + listener->NameOf(to));
  }
  return next(from, to);
}

}  // extern "C"

namespace antigrasp {
namespace {

class AtomicFileOrder : public testing::Test {
 protected:
  AtomicFileOrder() {
    listening_.folder = fs::canonical(folder_.path());
    listener = &listening_;
  }
  ~AtomicFileOrder() override { listener = nullptr; }

  shapes::TempFolder folder_;
  Listener listening_;
};

// A rename that reaches the disk before the bytes would leave an empty file after a power cut.
TEST_F(AtomicFileOrder, BytesAreOnDiskBeforeTheNewNameIs) {
  WriteFileAtomic(listening_.folder / "a.txt", std::string(100000, 'x'));
  EXPECT_EQ(listening_.calls,
            (std::vector<std::string>{"write temporary", "close temporary", "sync temporary",
                                      "close temporary", "rename temporary to a.txt",
                                      "close a.txt",  // the lock
                                      "sync folder", "close folder"}));
}

TEST_F(AtomicFileOrder, WhatTheDiskRefusesIsNotRenamed) {
  const fs::path target = listening_.folder / "a.txt";
  WriteFileAtomic(target, "old");
  listening_.calls.clear();
  listening_.refuse_sync = true;
  EXPECT_THROW(WriteFileAtomic(target, "new"), RuntimeFailure);
  EXPECT_EQ(listening_.calls,
            (std::vector<std::string>{"write temporary", "close temporary", "sync temporary",
                                      "close temporary", "close temporary"}));  // the lock
  EXPECT_EQ(ReadFile(target), "old");
  EXPECT_EQ(std::distance(fs::directory_iterator(listening_.folder), {}), 1);
}

}  // namespace
}  // namespace antigrasp
