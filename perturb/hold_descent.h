#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "antigrasp/mesh/triangle_mesh.h"
#include "antigrasp/perturb/change_budget.h"
#include "antigrasp/perturb/search_objective.h"
#include "antigrasp/perturb/smooth_field.h"
#include "antigrasp/quality/metric_options.h"

namespace antigrasp {

struct DescentOptions {
  ChangeBudget budget;
  int steps = 300;
  double first_step = 0.5;  // of a vector, percent of the diagonal; falls to a tenth
  double radius = 0.0;      // of the field, percent of the diagonal; 0 = by the budget
};

// A change of a solid with the moves of its vertices that it is made of (MovedBy).
struct SmoothChange {
  Eigen::MatrixX3d moves;  // where a share was taken, that share of them
  TriangleMesh mesh;       // single precision
};

// Descents on the share of executions whose contacts keep within their friction cones
// (EvaluateMeanHold) over a smooth field of moves, with penalties at the rims of the budget: Adam
// (Kingma and Ba 2015). Not in the paper; docs/perturbation.md, "Search on a judge".
class HoldDescent {
 public:
  // `start`: a solid in single precision (BeginPerturbation). Holds references to it and `metric`.
  HoldDescent(const TriangleMesh& start, const MetricOptions& metric, const DescentOptions& options,
              std::uint64_t seed);

  // From a random beginning, one for each `which`. 10 to 15 ms a step for 3,000 faces. Const and
  // thread-safe.
  SmoothChange Descend(std::uint64_t which) const;

  // The whole change, or as much of it as keeps the budget; the start where no share of it does.
  SmoothChange Kept(const Eigen::MatrixX3d& moves) const;

 private:
  Eigen::MatrixX3d Slope(const Eigen::MatrixX3d& moves, std::uint64_t which,
                         std::uint64_t step) const;

  const TriangleMesh& start_;
  const MetricOptions& metric_;
  DescentOptions options_;
  std::uint64_t seed_;
  BudgetKeeper keeper_;
  SmoothField field_;
  ObjectiveOptions objective_;
  std::vector<NoiseDraw> pool_;
};

// The solid after `options.steps` of a descent; less of the change where it would leave the box
// (the mesh's unit), the mesh itself where it is no solid or no part of the change will do.
TriangleMesh RefinedSolid(const TriangleMesh& mesh, const MetricOptions& metric,
                          const DescentOptions& options, const BoundingBox& within,
                          std::uint64_t seed);

}  // namespace antigrasp
