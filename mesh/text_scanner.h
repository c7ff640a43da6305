#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "antigrasp/core/error.h"

namespace antigrasp {

// Lines and words of a text file, with the line number for messages. Spaces, tabs and every kind of
// line end separate words; numbers are read the same way in every locale.
class TextScanner {
 public:
  TextScanner(std::string_view text, std::string path) : rest_(text), path_(std::move(path)) {}

  // The next line without its end; nullopt after the last. Words already taken are gone from it.
  std::optional<std::string_view> NextLine();
  // The next word, on this line or a later one; nullopt at the end of the file.
  std::optional<std::string_view> NextWord();
  // The next word as a number; InputError, naming `what`, when it is none.
  double NextNumber(const std::string& what);
  std::int64_t NextInteger(const std::string& what);

  std::string_view rest() const { return rest_; }
  std::string Where() const { return path_ + ":" + std::to_string(line_); }
  [[noreturn]] void Fail(const std::string& what, const std::string& expected) const {
    throw InputError(what, Where(), expected);
  }

 private:
  std::string_view rest_;
  std::string path_;
  int line_ = 1;  // that the last word came from
  int line_at_rest_ = 1;
};

// Takes the first word off the line; empty when there is none.
std::string_view TakeWord(std::string_view* line);
// The whole word as a number, in [+-]digits, decimal, exponent, nan or inf form.
std::optional<double> ParseNumber(std::string_view word);
std::optional<std::int64_t> ParseInteger(std::string_view word);
// For quoting in messages: at most 40 characters, unprintable ones as '?'.
std::string Quoted(std::string_view word);

}  // namespace antigrasp
