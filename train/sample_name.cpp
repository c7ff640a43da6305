#include "antigrasp/train/sample_name.h"

#include <charconv>
#include <string_view>

#include "antigrasp/core/format.h"

namespace antigrasp {
namespace {

constexpr std::string_view kSeries = "sample";

}  // namespace

std::string SampleName(std::int64_t index) { return NumberedName(kSeries, index); }

std::optional<std::int64_t> SampleIndex(const std::string& name) {
  std::string_view digits = name;
  if (digits.starts_with(kSeries) && digits.substr(kSeries.size()).starts_with('-')) {
    digits.remove_prefix(kSeries.size() + 1);
  }
  std::int64_t index = 0;
  const char* end = digits.data() + digits.size();
  const auto [last, error] = std::from_chars(digits.data(), end, index);
  if (error != std::errc() || last != end || index < 0) return std::nullopt;
  return index;
}

}  // namespace antigrasp
