#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

// libzip, for .cpp files of this folder alone.
namespace antigrasp {

// The arrays in an .npz archive. InputError, naming the path, for what is damaged.
class NpzArchive {
 public:
  explicit NpzArchive(const std::filesystem::path& path);
  ~NpzArchive();
  const std::vector<std::string>& Names() const { return names_; }  // without .npy
  // The first bytes of an array's file, all of them where there are no more than `most`.
  std::string Read(const std::string& name, std::size_t most) const;
  // All of it, piece by piece; InputError unless it has `size` bytes, and when it is packed tighter
  // than a hundred times and larger than 64 MiB: distances are not.
  void ReadAll(const std::string& name, std::uint64_t size,
               const std::function<void(std::string_view)>& use) const;

 private:
  struct Zip;
  std::unique_ptr<Zip> zip_;
  std::string path_;
  std::vector<std::string> names_;
};

// The same to write, not packed, as numpy.savez does: equal arrays give equal bytes.
class NpzOutput {
 public:
  // The archive comes to be in a file of its own; `Close` hands it on.
  explicit NpzOutput(const std::filesystem::path& path);
  ~NpzOutput();
  void Add(const std::string& name, std::string bytes);                      // a whole .npy file
  void AddFile(const std::string& name, const std::filesystem::path& file);  // there until Close()
  void Close();  // RuntimeFailure when the disk is full

 private:
  void AddSource(const std::string& name, void* source);
  struct Zip;
  std::unique_ptr<Zip> zip_;
  std::string path_;
  std::vector<std::unique_ptr<std::string>> held_;
};

}  // namespace antigrasp
