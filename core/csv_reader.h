#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace antigrasp {

// A comma-separated table with a header row, read row by row (RFC 4180: quoted fields with doubled
// quotes, commas and line breaks inside). LF and CRLF; a byte-order mark is skipped, so are empty
// lines. InputError with file:line for an empty file, bytes that are no text, a quote that is not
// closed or stands inside a field, a name twice in the header, a row with another number of fields.
class CsvReader {
 public:
  explicit CsvReader(const std::filesystem::path& path);
  static CsvReader OfText(std::string text, std::string name);  // `name` in place of the file's

  const std::vector<std::string>& names() const { return names_; }
  std::optional<std::size_t> Column(std::string_view name) const;
  std::size_t RequiredColumn(std::string_view name) const;  // InputError when there is none

  bool Next();  // to the next row; false behind the last
  const std::string& Field(std::size_t column) const { return fields_[column]; }
  // The field without blanks around it as a number; nullopt when it is none. "nan" and "inf" are.
  std::optional<double> Number(std::size_t column) const;
  // The same; NaN for an empty field, InputError for one that is no number.
  double NumberOrGap(std::size_t column) const;
  std::string Where() const;  // "file:line" of the row's first line

 private:
  CsvReader(std::string name, std::string text);
  bool ReadRecord();
  std::string ReadField();

  std::string path_, text_;
  std::size_t at_ = 0;
  int line_ = 1, first_line_ = 1;
  std::vector<std::string> names_, fields_;
  std::map<std::string, std::size_t, std::less<>> columns_;
};

}  // namespace antigrasp
