#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace antigrasp {

// How the arrays of a file of VTK are packed.
struct VtiPacking {
  std::size_t header_size = 4;  // bytes of a number before the values
  bool zlib = false;
};

// The values of an array as they stand in the file: raw, or as base64 in one piece or several.
class VtiBytes {
 public:
  // `read`: that many bytes of the file or fewer, from a place that counts from the array's first.
  using Read = std::function<std::string(std::uint64_t at, std::size_t size)>;
  VtiBytes(Read read, bool base64, std::string where);
  // The next ones; InputError when they end before.
  std::string Take(std::size_t size);

 private:
  void Decode();

  Read read_;
  bool base64_;
  std::string where_;
  std::uint64_t at_ = 0;
  std::string decoded_;
};

// All `size` bytes of the values, unpacked, piece by piece; InputError when the array does not have
// as many. What is in memory is bounded by 64 MiB, whatever the file says.
void UnpackVtiArray(VtiBytes* bytes, const VtiPacking& packing, std::uint64_t size,
                    const std::string& where, const std::function<void(std::string_view)>& use);

}  // namespace antigrasp
