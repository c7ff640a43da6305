#pragma once

#include <string>
#include <vector>

#include "antigrasp/core/csv_writer.h"
#include "antigrasp/export/print_check.h"

namespace antigrasp {

struct PrintedObject {
  std::string name, file;
  PrintCheck check;
};

// What the printer will find, object by object.
class PrintTable {
 public:
  explicit PrintTable(const PrintOptions& options);
  void Add(PrintedObject object);
  std::size_t size() const { return size_; }
  // print.csv, columns as docs/formats.md says, one row per object: what was added since the last
  // call, the header before the first row.
  std::string TakeText() { return csv_.TakeText(); }
  // One line an object for a few objects, and totals.
  std::string Summary() const;

 private:
  PrintOptions options_;
  CsvWriter csv_;
  std::vector<PrintedObject> first_;  // as many as get a line, and one more
  std::size_t size_ = 0, thin_ = 0, hanging_ = 0;
  double thinnest_, largest_overhang_ = 0.0;
};

}  // namespace antigrasp
