#include "antigrasp/datasets/npy_text.h"

#include <algorithm>
#include <charconv>
#include <cstring>

#include "antigrasp/core/error.h"
#include "antigrasp/datasets/npy_header.h"
#include "antigrasp/mesh/text_scanner.h"

namespace antigrasp {
namespace {

constexpr char32_t kReplacement = 0xFFFD;  // for bytes that are no UTF-8
constexpr std::uint64_t kLongestName = std::uint64_t{1} << 20;

std::u32string FromUtf8(std::string_view text) {
  std::u32string points;
  for (std::size_t i = 0; i < text.size();) {
    const auto first = static_cast<unsigned char>(text[i]);
    const std::size_t length = first < 0x80             ? 1
                               : (first & 0xE0) == 0xC0 ? 2
                               : (first & 0xF0) == 0xE0 ? 3
                               : (first & 0xF8) == 0xF0 ? 4
                                                        : 0;
    char32_t point = length == 1 ? first : first & (0x7FU >> length);
    bool good = length > 0 && i + length <= text.size();
    for (std::size_t k = 1; good && k < length; ++k) {
      const auto next = static_cast<unsigned char>(text[i + k]);
      good = (next & 0xC0) == 0x80;
      point = point << 6 | (next & 0x3F);
    }
    points += good ? point : kReplacement;
    i += good ? length : 1;
  }
  return points;
}

void AppendUtf8(char32_t point, std::string* text) {
  if (point > 0x10FFFF) point = kReplacement;
  const auto byte = [&](char32_t value) { text->push_back(static_cast<char>(value)); };
  if (point < 0x80) return byte(point);
  if (point < 0x800) {
    byte(0xC0 | point >> 6);
  } else {
    if (point < 0x10000) {
      byte(0xE0 | point >> 12);
    } else {
      byte(0xF0 | point >> 18);
      byte(0x80 | (point >> 12 & 0x3F));
    }
    byte(0x80 | (point >> 6 & 0x3F));
  }
  byte(0x80 | (point & 0x3F));
}

// The values of a small array; InputError where the bytes are not as many as its header says.
struct SmallArray {
  NpyHeader header;
  std::string_view values;
  std::uint64_t size;  // of a value
};
SmallArray Small(std::string_view bytes, std::uint64_t size_of_unit, const std::string& where) {
  SmallArray array{ParseNpyHeader(bytes, where), {}, 0};
  array.values = bytes.substr(array.header.size);
  std::uint64_t width = 0;
  const std::string& type = array.header.dtype;
  std::from_chars(type.data() + std::min<std::size_t>(2, type.size()), type.data() + type.size(),
                  width);
  array.size = width * size_of_unit;
  if (width <= kLongestName &&
      array.header.count() <= array.values.size() / std::max<std::uint64_t>(1, array.size) &&
      array.header.count() * array.size == array.values.size()) {
    return array;
  }
  throw InputError("truncated or too large", where, "an array as long as its header says");
}

template <typename T>
T ValueAt(const SmallArray& array, std::size_t i) {
  T value;
  std::memcpy(&value, array.values.data() + i * sizeof value, sizeof value);
  return value;
}

}  // namespace

std::string ValidUtf8(std::string_view text) {
  std::string valid;
  for (const char32_t point : FromUtf8(text)) AppendUtf8(point, &valid);
  return valid;
}

std::string NpyOfTexts(const std::vector<std::string>& texts, bool single) {
  std::vector<std::u32string> points;
  std::size_t longest = 1;
  for (const std::string& text : texts) {
    points.push_back(FromUtf8(text));
    longest = std::max(longest, points.back().size());
  }
  std::string bytes = NpyHeaderText(
      "<U" + std::to_string(longest),
      single ? std::vector<std::uint64_t>() : std::vector<std::uint64_t>{texts.size()});
  for (std::u32string& text : points) {
    text.resize(longest, U'\0');
    bytes.append(reinterpret_cast<const char*>(text.data()), longest * sizeof(char32_t));
  }
  return bytes;
}

std::string NpyOfNumbers(const std::vector<double>& numbers, bool single) {
  return NpyHeaderText("<f8", single ? std::vector<std::uint64_t>()
                                     : std::vector<std::uint64_t>{numbers.size()})
      .append(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(double));
}

std::string NpyOfSeed(std::uint64_t seed) {
  return NpyHeaderText("<u8", {}).append(reinterpret_cast<const char*>(&seed), sizeof seed);
}

std::vector<std::string> NpyTexts(std::string_view bytes, const std::string& where) {
  const std::string type = ParseNpyHeader(bytes, where).dtype;
  const bool wide = type.starts_with("<U");
  if (!wide && !type.starts_with("|S")) {
    throw InputError("type " + Quoted(type), where, "strings (<U or |S)");
  }
  const SmallArray array = Small(bytes, wide ? sizeof(char32_t) : 1, where);
  std::vector<std::string> texts;
  for (std::uint64_t i = 0; i < array.header.count(); ++i) {
    const std::string_view raw = array.values.substr(i * array.size, array.size);
    std::string text;
    for (std::size_t at = 0; at < raw.size(); at += wide ? sizeof(char32_t) : 1) {
      char32_t point = static_cast<unsigned char>(raw[at]);
      if (wide) std::memcpy(&point, raw.data() + at, sizeof point);
      if (point == 0) break;
      wide ? AppendUtf8(point, &text) : text.push_back(raw[at]);
    }
    texts.push_back(std::move(text));
  }
  return texts;
}

std::vector<double> NpyNumbers(std::string_view bytes, const std::string& where) {
  const SmallArray array = Small(bytes, 1, where);
  const std::string& type = array.header.dtype;
  std::vector<double> numbers;
  for (std::size_t i = 0; i < array.header.count(); ++i) {
    if (type == "<f8") {
      numbers.push_back(ValueAt<double>(array, i));
    } else if (type == "<f4") {
      numbers.push_back(static_cast<double>(ValueAt<float>(array, i)));
    } else if (type == "<i8") {
      numbers.push_back(static_cast<double>(ValueAt<std::int64_t>(array, i)));
    } else {
      throw InputError("type " + Quoted(type), where, "numbers (<f8, <f4 or <i8)");
    }
  }
  return numbers;
}

std::uint64_t NpySeed(std::string_view bytes, const std::string& where) {
  const SmallArray array = Small(bytes, 1, where);
  if ((array.header.dtype == "<u8" || array.header.dtype == "<i8") && array.header.count() == 1) {
    return ValueAt<std::uint64_t>(array, 0);
  }
  throw InputError("no whole number", where, "one of 64 bits");
}

}  // namespace antigrasp
