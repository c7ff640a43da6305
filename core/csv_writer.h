#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace antigrasp {

// A comma-separated table in memory, as CsvReader reads it: a header, then row by row its fields in
// the order of the header. A row of another number of fields is a broken invariant.
//   CsvWriter csv({"object", "width"});
//   csv.Text("mug").Number(0.04).EndRow();
class CsvWriter {
 public:
  explicit CsvWriter(const std::vector<std::string>& columns);

  CsvWriter& Text(std::string_view text);  // quoted only when it must be
  CsvWriter& Number(double value);         // reads back to the same double; "nan", "inf"
  CsvWriter& NumberOrGap(double value);    // the same; empty for NaN
  CsvWriter& Count(std::int64_t count);
  CsvWriter& CountOrGap(std::int64_t count);  // empty for a negative one
  CsvWriter& Numbers(std::initializer_list<double> values);
  CsvWriter& NumbersOrGaps(std::initializer_list<double> values);
  void EndRow();

  const std::string& text() const { return text_; }  // lines end in LF
  // What was added since the last call, the header before the first row: for tables that do not fit
  // into memory.
  std::string TakeText() { return std::exchange(text_, {}); }

 private:
  CsvWriter& Append(std::string_view field);

  std::string text_;
  std::size_t columns_;
  std::size_t in_row_ = 0;
};

}  // namespace antigrasp
