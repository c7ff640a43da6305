#include "antigrasp/core/csv_reader.h"

#include <algorithm>
#include <charconv>
#include <limits>
#include <utility>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/error.h"
#include "antigrasp/core/file_kind.h"

namespace antigrasp {
namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

std::string_view Trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

std::string ReadTable(const std::filesystem::path& path) {
  RefuseOtherKind(path, FileKind::kTable, "a table", "comma-separated text with a header row");
  return ReadFile(path);
}

std::string Fields(std::size_t count) {
  return std::to_string(count) + (count == 1 ? " field" : " fields");
}

}  // namespace

CsvReader::CsvReader(const std::filesystem::path& path)
    : CsvReader(path.string(), ReadTable(path)) {}

CsvReader CsvReader::OfText(std::string text, std::string name) {
  return {std::move(name), std::move(text)};
}

CsvReader::CsvReader(std::string name, std::string text)
    : path_(std::move(name)), text_(std::move(text)) {
  if (text_.starts_with(kByteOrderMark)) at_ = kByteOrderMark.size();
  const auto binary = std::find_if(text_.begin(), text_.end(), [](char c) {
    return static_cast<unsigned char>(c) < ' ' && c != '\t' && c != '\n' && c != '\r';
  });
  if (binary != text_.end()) {
    const auto line = 1 + std::count(text_.begin(), binary, '\n');
    throw InputError("not a table", path_ + ":" + std::to_string(line),
                     "comma-separated text without control characters");
  }
  if (!ReadRecord()) throw InputError("empty table", path_, "a header row and rows under it");
  for (const std::string& field : fields_) {
    names_.emplace_back(Trimmed(field));
    if (!columns_.emplace(names_.back(), names_.size() - 1).second) {
      throw InputError("column " + names_.back() + " twice", Where(), "every name once");
    }
  }
}

std::optional<std::size_t> CsvReader::Column(std::string_view name) const {
  const auto found = columns_.find(name);
  if (found == columns_.end()) return std::nullopt;
  return found->second;
}

std::size_t CsvReader::RequiredColumn(std::string_view name) const {
  const auto column = Column(name);
  if (!column) {
    throw InputError("no column " + std::string(name), path_ + ":1", "column " + std::string(name));
  }
  return *column;
}

bool CsvReader::Next() {
  if (!ReadRecord()) return false;
  if (fields_.size() != names_.size()) {
    throw InputError("a row of " + Fields(fields_.size()), Where(),
                     Fields(names_.size()) + " as in the header");
  }
  return true;
}

std::optional<double> CsvReader::Number(std::size_t column) const {
  std::string_view text = Trimmed(fields_[column]);
  if (text.starts_with('+') && text.size() > 1 && text[1] != '-') text.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

double CsvReader::NumberOrGap(std::size_t column) const {
  if (fields_[column].empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto number = Number(column);
  if (!number) {
    throw InputError(names_[column] + " = \"" + fields_[column] + "\"", Where(), "a number");
  }
  return *number;
}

std::string CsvReader::Where() const { return path_ + ":" + std::to_string(first_line_); }

bool CsvReader::ReadRecord() {
  while (at_ < text_.size() && (text_[at_] == '\n' || text_[at_] == '\r')) {
    line_ += text_[at_++] == '\n' ? 1 : 0;
  }
  fields_.clear();
  if (at_ == text_.size()) return false;
  first_line_ = line_;
  fields_.push_back(ReadField());
  while (at_ < text_.size() && text_[at_] == ',') {
    ++at_;
    fields_.push_back(ReadField());
  }
  return true;
}

// Up to the comma or the end of the line, which stays.
std::string CsvReader::ReadField() {
  if (at_ == text_.size() || text_[at_] != '"') {
    const std::size_t end = std::min(text_.find_first_of(",\r\n", at_), text_.size());
    std::string field = text_.substr(at_, end - at_);
    if (field.find('"') != std::string::npos) {
      throw InputError("a quote inside " + field, path_ + ":" + std::to_string(line_),
                       "the whole field in quotes, quotes in it doubled");
    }
    at_ = end;
    return field;
  }
  std::string field;
  const std::string opened = path_ + ":" + std::to_string(line_);
  for (++at_; at_ < text_.size(); ++at_) {
    line_ += text_[at_] == '\n' ? 1 : 0;
    if (text_[at_] != '"') {
      field += text_[at_];
    } else if (at_ + 1 < text_.size() && text_[at_ + 1] == '"') {
      field += text_[at_++];
    } else {
      ++at_;
      if (at_ == text_.size() || text_.find_first_of(",\r\n", at_) == at_) return field;
      throw InputError("text behind a closing quote", opened, "a comma or the end of the line");
    }
  }
  throw InputError("a quote that is never closed", opened, "a closing quote");
}

}  // namespace antigrasp
