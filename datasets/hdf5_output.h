#pragma once

#include <hdf5.h>

#include <array>
#include <filesystem>
#include <map>
#include <optional>

// Only for .cpp files of this folder: nobody else sees HDF5.
namespace antigrasp {

// A new file on disk for HDF5 to write to, through a driver of our own. The library does not
// survive a full disk: what it cannot write it cannot close either. So this one takes every write,
// remembers the first that failed, and keeps what the library reads back, all but the values of
// datasets, in memory: a few bytes a chunk.
class Hdf5Output {
 public:
  explicit Hdf5Output(std::filesystem::path path);
  ~Hdf5Output();
  Hdf5Output(const Hdf5Output&) = delete;
  Hdf5Output& operator=(const Hdf5Output&) = delete;

  // The next file made with these access properties goes here. This object outlives it.
  void Catch(hid_t file_access);
  // Throws RuntimeFailure when a write failed so far.
  void RequireWritten() const;

  // What the driver calls. They never fail.
  void Write(bool values, haddr_t address, std::size_t size, const char* bytes);
  void Read(haddr_t address, std::size_t size, char* bytes) const;
  void Truncate(haddr_t size);

 private:
  static constexpr std::size_t kPage = 4096;

  std::filesystem::path path_;
  int file_ = -1;
  int failure_ = 0;                                         // errno of the first write that failed
  std::map<haddr_t, std::array<char, kPage>> structure_{};  // by address / kPage
};

}  // namespace antigrasp
