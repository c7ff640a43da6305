#include "antigrasp/datasets/vti_bytes.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>
#include <vector>

#include "antigrasp/core/error.h"

namespace antigrasp {
namespace {

constexpr std::size_t kAtOnce = std::size_t{1} << 20;
constexpr std::uint64_t kLargestBlock = std::uint64_t{32} << 20;
constexpr const char* kWholeArray = "an array as long as its image";

// Six bits a letter; -1 for white space, -2 for what ends a group, -3 for anything else.
int SixBits(char letter) {
  static constexpr std::string_view kLetters =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  static const std::array<int, 256> table = [] {
    std::array<int, 256> values;
    values.fill(-3);
    for (std::size_t i = 0; i < kLetters.size(); ++i) {
      values[static_cast<unsigned char>(kLetters[i])] = static_cast<int>(i);
    }
    for (const char space : {' ', '\t', '\r', '\n'}) values[static_cast<unsigned char>(space)] = -1;
    values['='] = -2;
    return values;
  }();
  return table[static_cast<unsigned char>(letter)];
}

std::uint64_t NumberOf(const std::string& bytes) {
  std::uint64_t number = 0;  // little-endian
  std::memcpy(&number, bytes.data(), bytes.size());
  return number;
}

}  // namespace

VtiBytes::VtiBytes(Read read, bool base64, std::string where)
    : read_(std::move(read)), base64_(base64), where_(std::move(where)) {}

// Groups of four letters; one that ends in '=' may be followed by others, because VTK encodes the
// numbers before the values apart.
void VtiBytes::Decode() {
  std::uint32_t group = 0;
  int letters = 0, filled = 0;
  const std::string text = read_(at_, kAtOnce);
  std::size_t whole = 0;  // letters of whole groups
  for (std::size_t i = 0; i < text.size(); ++i) {
    const int bits = SixBits(text[i]);
    if (bits == -1) continue;
    if (bits == -3) break;
    group = group << 6 | static_cast<std::uint32_t>(std::max(bits, 0));
    if (bits == -2) ++filled;
    if (++letters < 4) continue;
    if (filled > 2) break;
    for (int k = 0; k < 3 - filled; ++k) {
      decoded_.push_back(static_cast<char>(group >> (16 - 8 * k) & 0xFF));
    }
    group = 0;
    letters = filled = 0;
    whole = i + 1;
  }
  if (whole == 0) throw InputError("an array ends early or is damaged", where_, kWholeArray);
  at_ += whole;
}

std::string VtiBytes::Take(std::size_t size) {
  if (!base64_) {
    std::string bytes = read_(at_, size);
    if (bytes.size() < size) throw InputError("an array ends early", where_, kWholeArray);
    at_ += size;
    return bytes;
  }
  while (decoded_.size() < size) Decode();
  std::string bytes = decoded_.substr(0, size);
  decoded_.erase(0, size);
  return bytes;
}

namespace {

void UnpackPlain(VtiBytes* bytes, const VtiPacking& packing, std::uint64_t size,
                 const std::string& where, const std::function<void(std::string_view)>& use) {
  const std::uint64_t stated = NumberOf(bytes->Take(packing.header_size));
  if (stated != size) {
    throw InputError("an array of " + std::to_string(stated) + " bytes", where,
                     std::to_string(size) + " of its image");
  }
  for (std::uint64_t left = size; left > 0;) {
    const std::size_t now = std::min<std::uint64_t>(left, kAtOnce);
    use(bytes->Take(now));
    left -= now;
  }
}

// Numbers before the blocks: how many, bytes of one, bytes of the last where it is shorter (else
// 0), and of each the bytes that it takes packed.
void UnpackBlocks(VtiBytes* bytes, const VtiPacking& packing, std::uint64_t size,
                  const std::string& where, const std::function<void(std::string_view)>& use) {
  const auto next = [&] { return NumberOf(bytes->Take(packing.header_size)); };
  const std::uint64_t blocks = next(), block = next(), last = next();
  const std::uint64_t whole = last == 0 ? blocks : blocks - 1;
  if (blocks == 0 || block == 0 || block > kLargestBlock || last > block ||
      blocks > size / block + 1 || whole * block + last != size) {
    throw InputError("packed blocks that are not " + std::to_string(size) + " bytes", where,
                     kWholeArray);
  }
  std::vector<std::uint64_t> packed;
  for (std::uint64_t i = 0; i < blocks; ++i) {
    packed.push_back(next());
    if (packed.back() > 2 * kLargestBlock) {
      throw InputError("a packed block larger than 64 MiB", where, kWholeArray);
    }
  }
  std::string values;
  for (std::uint64_t i = 0; i < blocks; ++i) {
    const std::string from = bytes->Take(packed[i]);
    values.resize(i < whole ? block : last);
    uLongf count = values.size();
    if (uncompress(reinterpret_cast<Bytef*>(values.data()), &count,
                   reinterpret_cast<const Bytef*>(from.data()), from.size()) != Z_OK ||
        count != values.size()) {
      throw InputError("a damaged block of zlib", where, kWholeArray);
    }
    use(values);
  }
}

}  // namespace

void UnpackVtiArray(VtiBytes* bytes, const VtiPacking& packing, std::uint64_t size,
                    const std::string& where, const std::function<void(std::string_view)>& use) {
  packing.zlib ? UnpackBlocks(bytes, packing, size, where, use)
               : UnpackPlain(bytes, packing, size, where, use);
}

}  // namespace antigrasp
