#include "antigrasp/core/csv_writer.h"

#include <cmath>

#include "antigrasp/core/check.h"
#include "antigrasp/core/format.h"

namespace antigrasp {

CsvWriter::CsvWriter(const std::vector<std::string>& columns) : columns_(columns.size()) {
  for (const std::string& name : columns) Text(name);
  EndRow();
}

CsvWriter& CsvWriter::Append(std::string_view field) {
  if (in_row_++ > 0) text_ += ',';
  text_ += field;
  return *this;
}

CsvWriter& CsvWriter::Text(std::string_view text) { return Append(CsvField(text)); }

CsvWriter& CsvWriter::Number(double value) { return Append(FormatDouble(value)); }

CsvWriter& CsvWriter::NumberOrGap(double value) {
  return std::isnan(value) ? Append("") : Number(value);
}

CsvWriter& CsvWriter::Count(std::int64_t count) { return Append(std::to_string(count)); }

CsvWriter& CsvWriter::CountOrGap(std::int64_t count) {
  return count < 0 ? Append("") : Count(count);
}

CsvWriter& CsvWriter::Numbers(std::initializer_list<double> values) {
  for (const double value : values) Number(value);
  return *this;
}

CsvWriter& CsvWriter::NumbersOrGaps(std::initializer_list<double> values) {
  for (const double value : values) NumberOrGap(value);
  return *this;
}

void CsvWriter::EndRow() {
  AG_CHECK(in_row_ == columns_, "as many fields as the header has names");
  text_ += '\n';
  in_row_ = 0;
}

}  // namespace antigrasp
