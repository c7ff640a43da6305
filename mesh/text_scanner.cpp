#include "antigrasp/mesh/text_scanner.h"

#include <algorithm>
#include <charconv>
#include <limits>

namespace antigrasp {
namespace {

constexpr std::string_view kBlanks = " \t\v\f\r\n";
constexpr std::string_view kLineEnds = "\r\n";
constexpr std::size_t kLongestQuote = 40;

template <typename Number>
std::optional<Number> Parse(std::string_view word) {
  if (word.starts_with('+') && !word.starts_with("+-")) word.remove_prefix(1);
  Number value{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (word.empty() || end != word.data() + word.size()) return std::nullopt;
  if (error == std::errc()) return value;
  // Beyond the range: too small is zero and too large infinite, which the caller then refuses.
  if constexpr (std::is_floating_point_v<Number>) {
    if (error == std::errc::result_out_of_range) {
      const bool small = word.find("e-") != word.npos || word.find("E-") != word.npos;
      return small ? 0.0 : std::numeric_limits<double>::infinity();
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::string_view> TextScanner::NextLine() {
  if (rest_.empty()) return std::nullopt;
  line_ = line_at_rest_;
  const std::size_t end = std::min(rest_.find_first_of(kLineEnds), rest_.size());
  const std::string_view line = rest_.substr(0, end);
  rest_.remove_prefix(end);
  if (!rest_.empty()) {
    rest_.remove_prefix(rest_.starts_with("\r\n") ? 2 : 1);
    ++line_at_rest_;
  }
  return line;
}

std::optional<std::string_view> TextScanner::NextWord() {
  const std::size_t start = std::min(rest_.find_first_not_of(kBlanks), rest_.size());
  for (std::size_t i = 0; i < start; ++i) {
    const bool ends_line =
        rest_[i] == '\n' || (rest_[i] == '\r' && !rest_.substr(i).starts_with("\r\n"));
    if (ends_line) ++line_at_rest_;
  }
  rest_.remove_prefix(start);
  line_ = line_at_rest_;
  if (rest_.empty()) return std::nullopt;
  const std::string_view word = rest_.substr(0, rest_.find_first_of(kBlanks));
  rest_.remove_prefix(word.size());
  return word;
}

double TextScanner::NextNumber(const std::string& what) {
  const auto word = NextWord();
  if (!word) Fail("file ends inside " + what, "a number");
  const auto value = ParseNumber(*word);
  if (!value) Fail(what + " = " + Quoted(*word), "a number");
  return *value;
}

std::int64_t TextScanner::NextInteger(const std::string& what) {
  const auto word = NextWord();
  if (!word) Fail("file ends inside " + what, "a whole number");
  const auto value = ParseInteger(*word);
  if (!value) Fail(what + " = " + Quoted(*word), "a whole number");
  return *value;
}

std::string_view TakeWord(std::string_view* line) {
  line->remove_prefix(std::min(line->find_first_not_of(kBlanks), line->size()));
  const std::string_view word = line->substr(0, line->find_first_of(kBlanks));
  line->remove_prefix(word.size());
  return word;
}

std::optional<double> ParseNumber(std::string_view word) { return Parse<double>(word); }

std::optional<std::int64_t> ParseInteger(std::string_view word) {
  return Parse<std::int64_t>(word);
}

std::string Quoted(std::string_view word) {
  std::string text(word.substr(0, kLongestQuote));
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return "'" + text + (word.size() > kLongestQuote ? "...'" : "'");
}

}  // namespace antigrasp
