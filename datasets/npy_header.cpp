#include "antigrasp/datasets/npy_header.h"

#include <Eigen/Core>
#include <algorithm>
#include <cstring>

#include "antigrasp/core/error.h"
#include "antigrasp/mesh/text_scanner.h"

namespace antigrasp {
namespace {

constexpr const char* kWantedArray = "an array of float32 as numpy.save writes it, in C order";
constexpr std::uint64_t kMostValues = std::uint64_t{1} << 62;

// What stands behind a key of the header, which is a dictionary as Python prints it.
std::string_view ValueOfKey(std::string_view text, std::string_view key, const std::string& where) {
  std::size_t at = text.find("'" + std::string(key) + "'");
  if (at != std::string_view::npos) at = text.find(':', at);
  if (at != std::string_view::npos) at = text.find_first_not_of(" ", at + 1);
  if (at != std::string_view::npos) return text.substr(at);
  throw InputError("NumPy header without " + std::string(key), where, kWantedArray);
}

std::vector<std::uint64_t> ParseShape(std::string_view text, const std::string& where) {
  const auto fail = [&] { return InputError("damaged shape in the header", where, kWantedArray); };
  const std::size_t end = text.find(')');
  if (!text.starts_with('(') || end == std::string_view::npos) throw fail();
  std::vector<std::uint64_t> shape;
  std::uint64_t number = 0;
  bool digits = false;
  for (const char c : text.substr(1, end)) {
    if (c >= '0' && c <= '9') {
      // No further than the limit: it would come round to something small.
      number = number > kMostValues / 16 ? kMostValues
                                         : number * 10 + static_cast<std::uint64_t>(c - '0');
      digits = true;
    } else if (c == ',' || c == ')') {
      if (digits) shape.push_back(number);
      number = 0;
      digits = false;
    } else if (c != ' ') {
      throw fail();
    }
  }
  return shape;
}

std::string ParseType(std::string_view text, const std::string& where) {
  if (text.starts_with('[')) throw InputError("an array of several fields", where, kWantedArray);
  const std::size_t end = text.find(text.empty() ? '\'' : text[0], 1);
  if (!text.starts_with('\'') || end == std::string_view::npos || end > 16) {
    throw InputError("damaged type in the header", where, kWantedArray);
  }
  const std::string type(text.substr(1, end - 1));
  if (type.find('O') != std::string::npos) {
    throw InputError("an array of Python objects", where, kWantedArray);
  }
  if (type.starts_with('>')) {
    throw InputError("big-endian numbers " + Quoted(type), where, "little-endian ones");
  }
  return type;
}

}  // namespace

std::uint64_t NpyHeader::count() const {
  std::uint64_t product = 1;
  for (const std::uint64_t extent : shape) {
    if (extent != 0 && product > kMostValues / extent) return kMostValues;
    product *= extent;
  }
  return product;
}

NpyHeader ParseNpyHeader(std::string_view first_bytes, const std::string& where) {
  const std::size_t prefix = kNpyMagic.size() + 2;
  if (first_bytes.size() < prefix + 4 || !first_bytes.starts_with(kNpyMagic)) {
    throw InputError("no NumPy array", where, kWantedArray);
  }
  const int version = first_bytes[kNpyMagic.size()];
  if (version < 1 || version > 3) {
    throw InputError("NumPy format " + std::to_string(version), where, "version 1 to 3");
  }
  std::uint32_t length = 0;  // 16 bits in version 1
  std::memcpy(&length, first_bytes.data() + prefix, version == 1 ? 2 : 4);
  const std::size_t begin = prefix + (version == 1 ? 2 : 4);
  if (length > kLongestNpyHeader || begin + length > first_bytes.size()) {
    throw InputError("truncated or damaged NumPy header", where, kWantedArray);
  }
  const std::string_view text = first_bytes.substr(begin, length);
  const std::size_t last = text.find_last_not_of(" \n");
  if (last == std::string_view::npos || text[last] != '}') {
    throw InputError("truncated or damaged NumPy header", where, kWantedArray);
  }
  NpyHeader header;
  header.size = begin + length;
  header.dtype = ParseType(ValueOfKey(text, "descr", where), where);
  header.shape = ParseShape(ValueOfKey(text, "shape", where), where);
  if (!ValueOfKey(text, "fortran_order", where).starts_with("False") && header.shape.size() > 1) {
    throw InputError("an array in Fortran order", where, "numpy.ascontiguousarray of it");
  }
  return header;
}

std::string NpyHeaderText(std::string_view dtype, const std::vector<std::uint64_t>& shape) {
  std::string text = "{'descr': '" + std::string(dtype) + "', 'fortran_order': False, 'shape': (";
  for (std::size_t i = 0; i < shape.size(); ++i) {
    text += (i > 0 ? " " : "") + std::to_string(shape[i]) +
            (i + 1 < shape.size() || shape.size() == 1 ? "," : "");
  }
  text += "), }";
  const std::size_t prefix = kNpyMagic.size() + 4;
  while ((prefix + text.size() + 1) % 64 != 0) text += ' ';
  text += '\n';
  const auto length = static_cast<std::uint16_t>(text.size());
  std::string header(kNpyMagic);
  header += {'\1', '\0', static_cast<char>(length & 0xFF), static_cast<char>(length >> 8)};
  return header + text;
}

std::size_t NpyFloatSize(const NpyHeader& header, const std::string& where) {
  for (const std::size_t size : {2U, 4U, 8U}) {
    if (header.dtype == "<f" + std::to_string(size)) return size;
  }
  throw InputError("numbers of type " + Quoted(header.dtype), where,
                   "float32 (<f4), float64 or float16");
}

void NpyToFloats(std::string_view bytes, std::size_t float_size, std::span<float> values) {
  if (float_size == sizeof(float)) {
    std::memcpy(values.data(), bytes.data(), bytes.size());
    return;
  }
  for (std::size_t i = 0; i < values.size(); ++i) {
    const char* const at = bytes.data() + i * float_size;
    if (float_size == sizeof(double)) {
      double value = 0.0;
      std::memcpy(&value, at, sizeof value);
      values[i] = static_cast<float>(value);
    } else {
      std::uint16_t bits = 0;
      std::memcpy(&bits, at, sizeof bits);
      values[i] = static_cast<float>(Eigen::numext::bit_cast<Eigen::half>(bits));
    }
  }
}

}  // namespace antigrasp
