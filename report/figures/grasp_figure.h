#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "antigrasp/quality/graspability.h"
#include "antigrasp/report/figures/object_picture.h"

namespace antigrasp {

struct GraspedObject {
  std::string name, status;  // status: "ok", or what to say beside or instead of the number
  TriangleMesh mesh;         // may be empty
  Graspability score;        // its grasps are in the mesh's frame times score.scale
};

// |F_a| of one object on the way (perturb's history.csv).
struct PairHistory {
  std::string object;
  std::vector<double> iteration, pairs;  // NaN: a gap
};

// Figure 1 of the paper: objects with the axes of their most robust grasps, and above the plot of
// antipodal pairs of faces.
struct GraspFigure {
  std::vector<GraspedObject> objects;
  std::vector<PairHistory> histories;  // none: no plot
  int shown = 25;                      // most robust grasps drawn of each object
  std::string caption;                 // of the legend: what was sampled
};

// Axes from green to red by reliability relative to all grasps shown in the figure: red the least,
// green the 95th percentile and above. An axis runs through both contacts and beyond them; behind
// the object it is faint. Objects in a row share
// one scale, all one camera. The plot stands at the end of the first row.
void WriteGraspFigure(const std::filesystem::path& path, const GraspFigure& figure,
                      const FigureOptions& options);

}  // namespace antigrasp
