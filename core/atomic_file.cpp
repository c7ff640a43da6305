#include "antigrasp/core/atomic_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <map>
#include <regex>
#include <sstream>

#include "antigrasp/core/error.h"

namespace antigrasp {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void FailIo(const std::string& doing, const fs::path& path) {
  throw RuntimeFailure("cannot " + doing + " " + path.string() + ": " + std::strerror(errno));
}

void SyncToDisk(const fs::path& path, int flags) {
  const int fd = ::open(path.c_str(), flags);
  if (fd < 0) FailIo("open", path);
  const int rc = ::fsync(fd);
  ::close(fd);
  if (rc != 0) FailIo("write", path);
}

fs::path FolderOf(const fs::path& target) {
  return target.has_parent_path() ? target.parent_path() : fs::path(".");
}

// Nobody gives such a name to a file of their own.
std::string TemporaryName(const std::string& name, const std::string& writer) {
  return "." + name + ".antigrasp" + writer + ".tmp";
}

bool IsTemporaryName(const std::string& name) {
  static const std::regex pattern(R"(\..+\.antigrasp(-p?[0-9]+)?\.tmp)");
  return std::regex_match(name, pattern);
}

}  // namespace

AtomicFile::AtomicFile(fs::path target) : target_(std::move(target)) {
  std::error_code ignored;
  // What a link leads to is written, the link stays.
  if (fs::is_symlink(target_, ignored)) target_ = fs::weakly_canonical(target_);
  const fs::path folder = FolderOf(target_);
  if (!fs::is_directory(folder, ignored)) {
    throw InputError("cannot write " + target_.string(), folder.string(),
                     "an existing folder to write into");
  }
  if (fs::is_directory(target_, ignored)) {
    throw InputError("cannot write " + target_.string(), target_.string(),
                     "a file name, not a folder");
  }
  if (fs::exists(target_, ignored) && !fs::is_regular_file(target_, ignored)) {
    throw InputError("cannot write " + target_.string(), target_.string(),
                     "a file, not a device, pipe or socket");
  }
  if (::access(folder.c_str(), W_OK) != 0) {
    throw InputError("cannot write " + target_.string(), folder.string(), "a writable folder");
  }
  // Room for what stands around it in the 255 bytes of a name.
  const std::string name = target_.filename().string().substr(0, 200);
  for (int writer = 1; writer == 1 || lock_->state() == FileLock::State::kTaken; ++writer) {
    temp_ = folder / TemporaryName(name, writer == 1 ? "" : "-" + std::to_string(writer));
    lock_.emplace(temp_);
  }
  // Nor can what another user left be written to.
  if (!lock_->held() || !lock_->Write("")) {
    temp_ = folder / TemporaryName(name, "-p" + std::to_string(::getpid()));
    lock_.emplace(temp_);
  }
}

AtomicFile::~AtomicFile() {
  if (committed_) return;
  std::error_code ignored;
  fs::remove(temp_, ignored);
}

void AtomicFile::Append(std::string_view bytes) {
  if (!out_.is_open()) out_.open(temp_, std::ios::binary | std::ios::trunc);
  out_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  out_.flush();
  if (!out_) FailIo("write", target_);
}

void AtomicFile::Commit() {
  out_.close();
  SyncToDisk(temp_, O_WRONLY);
  if (std::rename(temp_.c_str(), target_.c_str()) != 0) FailIo("rename to", target_);
  committed_ = true;
  lock_.reset();  // at once: HDF5 refuses to read what is locked
  SyncToDisk(FolderOf(target_), O_RDONLY | O_DIRECTORY);  // the rename itself survives a power cut
}

void WriteFileAtomic(const fs::path& target, std::string_view bytes) {
  AtomicFile file(target);
  file.Append(bytes);
  file.Commit();
}

int RemoveAbandonedFiles(const fs::path& folder) {
  int removed = 0;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    if (!IsTemporaryName(entry.path().filename().string()) ||
        entry.symlink_status().type() != fs::file_type::regular) {
      continue;
    }
    FileLock lock(entry.path(), FileLock::Missing::kLeave);
    if (!lock.held()) continue;  // somebody writes it
    lock.RemoveFile();
    ++removed;
  }
  return removed;
}

void RequireFile(const fs::path& path, const std::string& expected) {
  std::error_code ignored;
  const fs::file_status status = fs::status(path, ignored);
  if (!fs::exists(status)) throw InputError("no such file", path.string(), expected);
  if (fs::is_directory(status)) throw InputError("is a folder", path.string(), expected);
  if (!fs::is_regular_file(status)) throw InputError("not a file", path.string(), expected);
  if (::access(path.c_str(), R_OK) != 0) throw InputError("not readable", path.string(), expected);
}

std::string ReadFile(const fs::path& path) {
  RequireFile(path, "a readable file");
  std::ifstream in(path, std::ios::binary);
  std::ostringstream bytes;
  bytes << in.rdbuf();
  if (!in) throw InputError("read error", path.string(), "a readable file");
  return std::move(bytes).str();
}

void RequireApart(const std::vector<fs::path>& written) {
  std::map<fs::path, fs::path> seen;  // as given, by the file it names
  for (const fs::path& path : written) {
    if (path.empty()) continue;
    std::error_code error;
    // Absolute first: of a relative path whose first part is not there yet it would stay relative.
    const fs::path real = fs::weakly_canonical(fs::absolute(path), error);
    const auto [at, fresh] = seen.emplace(error ? path : real, path);
    if (!fresh) {
      throw InputError("two files would be written as one", path.string(),
                       "another name than " + at->second.string());
    }
  }
}

void RequireNotRead(const fs::path& read, const std::vector<fs::path>& written) {
  if (read.empty()) return;
  for (const fs::path& path : written) {
    if (path.empty() || fs::weakly_canonical(path) != fs::weakly_canonical(read)) continue;
    throw InputError("would be written over a file that is read", path.string(), "another --out");
  }
}

void MakeFolder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error || !fs::is_directory(folder)) {
    throw InputError("cannot create " + folder.string() + ": " + error.message(), folder.string(),
                     "a folder or a path where one can be made");
  }
  if (::access(folder.c_str(), W_OK) != 0) {
    throw InputError("cannot write", folder.string(), "a writable folder");
  }
}

}  // namespace antigrasp
