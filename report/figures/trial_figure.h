#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "antigrasp/core/statistics.h"
#include "antigrasp/report/figures/object_picture.h"

namespace antigrasp {

// Percent held of a set at one friction and load, at one kind of mass.
struct TriedSet {
  std::string masses;  // a name: "own mass"; its kinds are drawn in the order in which they come
  double friction = 0.0;
  std::string load;            // a name: "1 g"; the same
  MeanInterval after, before;  // NaN: not tried; a half width of NaN: no interval
};

struct TrialFigure {
  std::vector<TriedSet> sets;
  std::string caption;  // the judge, and how many objects
};

// Percent held over friction at the first load, with 95 % intervals, and beside it, for each kind
// of mass, over load at each friction. After a change: full lines and dots, before it: dashed ones
// and rings.
void WriteTrialFigure(const std::filesystem::path& path, const TrialFigure& figure,
                      const FigureOptions& options);

}  // namespace antigrasp
