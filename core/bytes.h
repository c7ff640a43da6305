#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "antigrasp/core/error.h"

// Values as bytes, for another process of the same program on a machine of the same kind: no
// format of files.
namespace antigrasp {

template <typename T>
concept PlainValue = std::is_trivially_copyable_v<T> && !std::is_pointer_v<T>;

class ByteWriter {
 public:
  template <PlainValue T>
  void Put(const T& value) {
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  template <PlainValue T>
  void PutAll(const std::vector<T>& values) {
    Put(static_cast<std::uint64_t>(values.size()));
    bytes_.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
  }
  void PutText(std::string_view text) {
    Put(static_cast<std::uint64_t>(text.size()));
    bytes_.append(text);
  }
  std::string Take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

// Reads what a ByteWriter wrote, in the same order. RuntimeFailure where the bytes end before, or
// are more than were asked for.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : left_(bytes) {}

  template <PlainValue T>
  T Get() {
    T value;
    std::memcpy(&value, Next(sizeof value), sizeof value);
    return value;
  }
  template <PlainValue T>
  std::vector<T> GetAll() {
    const auto count = Get<std::uint64_t>();
    if (count > left_.size() / sizeof(T)) Refuse();
    std::vector<T> values(count);
    if (count > 0) std::memcpy(values.data(), Next(count * sizeof(T)), count * sizeof(T));
    return values;
  }
  std::string GetText() {
    const auto size = Get<std::uint64_t>();
    if (size > left_.size()) Refuse();
    return {Next(size), size};
  }
  void End() const {
    if (!left_.empty()) Refuse();
  }

 private:
  [[noreturn]] static void Refuse() {
    throw RuntimeFailure("another process sent bytes of another length than were expected");
  }
  const char* Next(std::size_t size) {
    if (size > left_.size()) Refuse();
    const char* begin = left_.data();
    left_.remove_prefix(size);
    return begin;
  }

  std::string_view left_;
};

}  // namespace antigrasp
