#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace antigrasp {

// The files in a zip archive, by libzip. What is unpacked of all is bounded by 64 MiB and a hundred
// times the archive, at most 1 GiB: no mesh is packed tighter.
class ZipParts {
 public:
  // InputError that names `path` when the bytes, which must outlive this, are no zip archive.
  ZipParts(std::string_view bytes, std::string path);
  ~ZipParts();
  bool Has(const std::string& name) const;
  // One file, piece by piece; InputError when it is not there, damaged or larger than the bound.
  void Read(const std::string& name, const std::function<void(std::string_view)>& use);

 private:
  struct Archive;
  std::unique_ptr<Archive> archive_;
  std::string path_;
  std::uint64_t left_;  // bytes that may still be unpacked
};

}  // namespace antigrasp
