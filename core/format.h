#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace antigrasp {

// Shortest decimal text that reads back to the same double; "nan", "inf", "-inf".
std::string FormatDouble(double value);
// "1m 05s", "2h 10m", "3.2s".
std::string FormatDuration(double seconds);
// "sample-000012": an item of a numbered series, six digits or more.
std::string NumberedName(std::string_view series, std::int64_t number);
// One CSV field, quoted only when it must be (RFC 4180).
std::string CsvField(std::string_view text);

}  // namespace antigrasp
