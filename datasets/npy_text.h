#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace antigrasp {

// Small arrays of NumPy as bytes of an .npy file, and back. `single`: of shape () instead of [N].
// Reading throws InputError that names `where` for arrays of other types.
std::string NpyOfTexts(const std::vector<std::string>& texts, bool single);  // <U, from UTF-8
std::string NpyOfNumbers(const std::vector<double>& numbers, bool single);   // <f8
std::string NpyOfSeed(std::uint64_t seed);                                   // <u8, of shape ()

// The text, U+FFFD in the place of bytes that are no UTF-8.
std::string ValidUtf8(std::string_view text);

std::vector<std::string> NpyTexts(std::string_view bytes, const std::string& where);  // <U, |S
std::vector<double> NpyNumbers(std::string_view bytes, const std::string& where);  // <f4, <f8, <i8
std::uint64_t NpySeed(std::string_view bytes, const std::string& where);           // <u8, <i8

}  // namespace antigrasp
