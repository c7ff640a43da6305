#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace antigrasp {

inline constexpr std::string_view kNpyMagic = "\x93NUMPY";
inline constexpr std::size_t kLongestNpyHeader = std::size_t{1} << 16;

// What an array in NumPy's format says of itself (NEP 1, versions 1 to 3).
struct NpyHeader {
  std::string dtype;  // "<f4"
  std::vector<std::uint64_t> shape;
  std::size_t size = 0;         // of the header: its values begin there
  std::uint64_t count() const;  // of its values, at most 2^62
};

// From its first bytes. InputError, naming `where`, for what is damaged, in Fortran's order, of
// objects, of several fields or with the most significant byte first.
NpyHeader ParseNpyHeader(std::string_view first_bytes, const std::string& where);

// Of version 1: the values follow.
std::string NpyHeaderText(std::string_view dtype, const std::vector<std::uint64_t>& shape);

// Bytes of a value of such an array of float16, float32 or float64; InputError for other numbers.
std::size_t NpyFloatSize(const NpyHeader& header, const std::string& where);
// Those numbers as float32.
void NpyToFloats(std::string_view bytes, std::size_t float_size, std::span<float> values);

}  // namespace antigrasp
