#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "antigrasp/core/bytes.h"
#include "antigrasp/core/error.h"

namespace antigrasp {

// Eigen's vectors and matrices of a size known when compiled, by their looks.
template <typename T>
concept FixedMatrix = requires(T matrix) {
  T::SizeAtCompileTime;
  matrix.data();
};

// Values of any make as bytes for another process (bytes.h), each type's fields listed once for
// both ways: beside the type stands
//   void PassFields(Passer& pass, Share& share) { pass(share.value, share.interval); }
// Known are plain values, texts, vectors, arrays, optionals and Eigen's small matrices.
// RuntimeFailure where bytes end too soon or there are more than were asked for.
class Passer {
 public:
  Passer() = default;  // writes
  explicit Passer(std::string_view bytes) : reads_(true), left_(bytes) {}

  template <typename... T>
  void operator()(T&... values) {
    (One(values), ...);
  }

  std::string Take() { return std::move(bytes_); }
  void End() const { ByteReader(left_).End(); }

 private:
  template <typename T>
  void One(T& value) {
    if constexpr (PlainValue<T>) {
      Raw(&value, sizeof value);
    } else if constexpr (FixedMatrix<T>) {
      Raw(value.data(), static_cast<std::size_t>(T::SizeAtCompileTime) * sizeof *value.data());
    } else {
      PassFields(*this, value);
    }
  }
  void One(std::string& text) {
    const std::size_t size = Resized(&text);
    Raw(text.data(), size);
  }
  template <typename T>
  void One(std::vector<T>& values) {
    const std::size_t size = Resized(&values);
    if constexpr (PlainValue<T>) {
      Raw(values.data(), size * sizeof(T));
    } else {
      for (T& value : values) One(value);
    }
  }
  template <typename T, std::size_t N>
  void One(std::array<T, N>& values) {
    for (T& value : values) One(value);
  }
  template <typename T>
  void One(std::optional<T>& value) {
    std::uint8_t is = value.has_value() ? 1 : 0;
    Raw(&is, sizeof is);
    if (is != 0 && reads_) value.emplace();
    if (is != 0) One(*value);
  }

  // Its number of elements, taken from the bytes when reading: each takes a byte at least.
  template <typename Values>
  std::size_t Resized(Values* values) {
    std::uint64_t size = values->size();
    Raw(&size, sizeof size);
    using Value = typename Values::value_type;
    const std::size_t least = PlainValue<Value> ? sizeof(Value) : 1;
    if (reads_ && size > left_.size() / least) ByteReader("").Get<char>();  // refuses
    if (reads_) values->resize(size);
    return size;
  }
  void Raw(void* data, std::size_t size) {
    if (!reads_) {
      bytes_.append(static_cast<const char*>(data), size);
      return;
    }
    if (size > left_.size()) ByteReader("").Get<char>();  // refuses
    if (size > 0) std::memcpy(data, left_.data(), size);
    left_.remove_prefix(size);
  }

  bool reads_ = false;
  std::string bytes_;
  std::string_view left_;
};

// One value there and back.
template <typename T>
std::string PassedBytes(T value) {
  Passer pass;
  pass(value);
  return pass.Take();
}
template <typename T>
T FromPassed(std::string_view bytes) {
  T value{};
  Passer pass(bytes);
  pass(value);
  pass.End();
  return value;
}

}  // namespace antigrasp
