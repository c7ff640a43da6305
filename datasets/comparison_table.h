#pragma once

#include <string>
#include <vector>

#include "antigrasp/datasets/surface_comparison.h"

namespace antigrasp {

// What `compare` says of two sets of `shapes` shapes each (docs/similarity.md): as a table for
// programs (docs/formats.md) and as one for the eye.
class ComparisonTable {
 public:
  ComparisonTable(const SurfaceComparison& found, std::size_t shapes, int samples_left_out,
                  int reference_left_out);
  std::string Csv() const;
  std::string Text() const;

  // NaN where a number does not exist.
  struct Row {
    const char* name;   // in the file
    const char* label;  // on the screen, with the unit
    double samples, reference;
    double factor = 1.0;  // on the screen: 100 for percent
  };
  const std::vector<Row>& rows() const { return rows_; }

 private:
  std::vector<Row> rows_;
};

// What speaks against taking the numbers at their word: sets of different sizes, distances that are
// largely chance.
std::vector<std::string> DoubtsOf(const SurfaceComparison& found);

}  // namespace antigrasp
