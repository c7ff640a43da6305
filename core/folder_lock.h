#pragma once

#include <filesystem>
#include <string>

#include "antigrasp/core/file_lock.h"

namespace antigrasp {

// One process at a time works in a folder: a lock on FOLDER/.lock, which says who holds it and goes
// with this object. The one of a killed process stays and blocks nobody.
class FolderLock {
 public:
  // InputError when another process has it: "process 4711 on anvil DOING (FOLDER): expected ...".
  FolderLock(const std::filesystem::path& folder, const std::string& doing);
  ~FolderLock();

  // False where nobody can be kept out: the file system has no locks, or nothing can be written.
  bool held() const { return lock_.held(); }

 private:
  FileLock lock_;
};

}  // namespace antigrasp
