#pragma once

#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "antigrasp/core/file_lock.h"

namespace antigrasp {

// A file that appears whole or not at all: write to temp_path(), then Commit() syncs it to disk and
// renames it onto the target. Without Commit() the destructor removes the temporary file and the
// target stays as it was. The parent folder must exist (InputError otherwise).
//
// The temporary file, .NAME.antigrasp.tmp, is there and locked from the beginning. What a killed
// writer left under that name is nobody's, and the next writer of the same target takes it over. A
// second living writer gets a name of its own (.NAME.antigrasp-2.tmp); so does one on a file system
// without locks, by its process.
class AtomicFile {
 public:
  explicit AtomicFile(std::filesystem::path target);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  const std::filesystem::path& temp_path() const { return temp_; }
  void Append(std::string_view bytes);  // RuntimeFailure when the disk is full
  void Commit();  // RuntimeFailure when the disk is full or the rename is refused

 private:
  std::filesystem::path target_;
  std::filesystem::path temp_;
  std::ofstream out_;  // open once something was appended
  std::optional<FileLock> lock_;
  bool committed_ = false;
};

// The same for bytes in memory.
void WriteFileAtomic(const std::filesystem::path& target, std::string_view bytes);

// Removes the temporary files of killed writers from a folder (not from the folders in it): those
// that no living process holds. Returns how many.
int RemoveAbandonedFiles(const std::filesystem::path& folder);

// Whole file as bytes. InputError when it is missing, a directory or unreadable.
std::string ReadFile(const std::filesystem::path& path);

// Throws InputError unless `path` is an existing, regular, readable file. `expected` ends the line.
void RequireFile(const std::filesystem::path& path, const std::string& expected);

// InputError when two of the files to be written are one; empty paths are none.
void RequireApart(const std::vector<std::filesystem::path>& written);

// InputError when a file that is read would be written over. Empty paths are none.
void RequireNotRead(const std::filesystem::path& read,
                    const std::vector<std::filesystem::path>& written);

// Creates the folder (and parents). InputError when something else is in the way or not writable.
void MakeFolder(const std::filesystem::path& folder);

}  // namespace antigrasp
