#include "antigrasp/core/folder_lock.h"

#include <unistd.h>

#include <array>
#include <fstream>

#include "antigrasp/core/error.h"

namespace antigrasp {
namespace {

std::string ThisProcess() {
  std::array<char, 256> host{};
  ::gethostname(host.data(), host.size() - 1);
  return "process " + std::to_string(::getpid()) + " on " + host.data();
}

std::string HolderOf(const std::filesystem::path& file) {
  std::string line;
  std::getline(std::ifstream(file), line);
  return line.empty() ? "another process" : line;  // it has only just got the lock
}

}  // namespace

FolderLock::FolderLock(const std::filesystem::path& folder, const std::string& doing)
    : lock_(folder / ".lock") {
  if (lock_.state() == FileLock::State::kTaken) {
    throw InputError(HolderOf(folder / ".lock") + " " + doing, folder.string(),
                     "one process at a time: wait for it or stop it");
  }
  if (lock_.held()) lock_.Write(ThisProcess() + "\n");
}

FolderLock::~FolderLock() {
  if (lock_.held()) lock_.RemoveFile();
}

}  // namespace antigrasp
