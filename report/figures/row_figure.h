#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "antigrasp/report/figures/object_picture.h"

namespace antigrasp {

struct FigureExample {
  TriangleMesh mesh;    // empty: a gap
  std::string caption;  // beneath
};

// Objects and the distribution of their set.
struct FigureRow {
  std::string label;                    // beside the row, upward
  std::vector<FigureExample> examples;  // may be fewer than other rows have
  std::vector<double> values;           // NaN: not counted; empty: a gap
  std::vector<double> reference;        // drawn as an outline; may be empty
  std::string gap;                      // what to say where the values are missing
};

// Figures 3 and 4 of the paper: rows of objects with the histogram of their set at the end.
struct RowFigure {
  std::vector<FigureRow> rows;
  std::vector<std::string> titles;          // above the examples, by column; may be fewer
  std::string values_name, reference_name;  // in the legend
  std::string axis = "normalised graspability";
};

// Histograms share their axes and bins; kappa, the mean of a row's values, and their number stand
// in each. What lies beyond the axis (the upper half percent of all values may) counts in the last
// bin. The objects of a row share one scale, all one camera.
void WriteRowFigure(const std::filesystem::path& path, const RowFigure& figure,
                    const FigureOptions& options);

}  // namespace antigrasp
