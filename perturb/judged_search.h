#pragma once

#include "antigrasp/core/options.h"
#include "antigrasp/core/parallel.h"
#include "antigrasp/core/rng.h"
#include "antigrasp/mesh/triangle_mesh.h"
#include "antigrasp/perturb/change_budget.h"
#include "antigrasp/perturb/perturbation.h"
#include "antigrasp/quality/judge.h"
#include "antigrasp/quality/metric_options.h"

namespace antigrasp {

// Not in the paper: the search on a judge, a trial in physics before all. Moves are smooth at the
// scale of the object, because ripples are no loss in physics: the body slips by a millimetre and
// is caught (docs/perturbation.md, "Search on a judge").
//
//   minimise    what the judge says of the object, on draws that it has not seen
//   over        a smooth field of moves (smooth_field.h): vectors at some 60 to 150 points
//   such that   the budget is kept (change_budget.h), and the result is a printable solid
//
// 1. Descents, from a few random starts. Their objective is cheap and has a slope: the share of
//    executions whose contacts keep within their friction cones, and penalties at the rims of the
//    budget (hold_descent.h). What they come to is pulled back towards the original until it
//    keeps the budget, and judged.
// 2. Evolution (CMA-ES, evolution.h) on the judge alone, from the best of these: a coarse field on
//    top, grasps and draws new in every generation and the same for all of one.
// 3. The best ones are judged anew beside the original; the original stays if none is better.
struct JudgedSearchOptions {
  ChangeBudget budget;
  int starts = 4;
  int descent_steps = 300;
  double descent_step = 0.5;  // first step of a vector, percent of the diagonal; falls to a tenth
  double radius = 0.0;        // of the field, percent of the diagonal; 0 = by the budget
  int generations = 15;       // of evolution, some 15 objects each; 0 = none
  double coarse_radius = 25.0;
  double spread = 1.0;    // of the first generation, percent of the diagonal
  int judge_grasps = 20;  // that the judge `trial` plans in the search
  int judge_draws = 4;    // executions of each
};
void Bind(OptionTable* table, JudgedSearchOptions* options);  // keys "search.*"

// The mesh must be a solid (failure otherwise). The result depends on the mesh, the options, the
// stream and the judge, not on the number of threads (0 = all). result.iterations counts steps and
// judged objects, result.moved is 0 when the original was kept. A judge that stops ends the search:
// result.failure says so. About a minute an object and core with a trial as judge: starts * 4 s,
// generations * 2 s.
PerturbResult PerturbByJudge(const TriangleMesh& mesh, const MetricOptions& metric,
                             const JudgedSearchOptions& options, Judge* judge, int threads,
                             RngStream* rng, const ProgressFn& progress = nullptr);

}  // namespace antigrasp
