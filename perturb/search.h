#pragma once

#include "antigrasp/core/options.h"
#include "antigrasp/core/parallel.h"
#include "antigrasp/core/rng.h"
#include "antigrasp/mesh/triangle_mesh.h"
#include "antigrasp/perturb/perturbation.h"
#include "antigrasp/perturb/search_objective.h"
#include "antigrasp/quality/metric_options.h"

namespace antigrasp {

// Not in the paper: descent on the metric itself under the constraint of section IV-B.
//
//   minimise    the percentile of the robust quality over antipodal, reachable grasps (III-B)
//   over        one height per vertex, along its normal on the original
//   such that   every face normal stays within alpha of the ORIGINAL's, the result is a printable
//               solid, vertices stay in the bounding box (extents change by 2 % at most) and
//               within max_move of where they were (a coarse mesh could lose its volume else)
//
// Each step draws fresh grasps and noise on the mesh as it is now, takes the derivative of a smooth
// percentile (search_objective.h) by all heights at once, makes an Adam step and turns the faces
// that left their cone back (search_projection.h). Some states of the second half are made exact
// (single precision, every face and the whole solid tested) and scored by the metric on a fixed set
// of grasps and draws; the best one is taken, the original if none is better. The search has a seed
// of its own, drawn from `rng`: a later evaluation's grasps and draws are others.
//
// Cost: 3-4 s an object of 2,500-5,500 faces with the defaults (10 ms a step), single thread.
// Mean graspability falls by 37 % / 28 % / 31 % on 20 cylinders / prisms / bottles at 10 degrees.
struct SearchOptions {
  double alpha = 10.0;  // degrees
  int steps = 300;
  double step = 0.3;          // Adam's first step per vertex, mean edge lengths
  double last_step = 0.1;     // the last one, as a share of the first; geometric in between
  double start_noise = 0.02;  // heights to begin with, mean edge lengths: a flat side has no slope
  int coarse = 0;             // passes that smooth the first derivative over the surface, see Bind
  int sweeps = 10;            // of the projection in a step
  bool keep_extents = true;
  double max_move = 6.0;   // of a vertex, percent of the bounding box's diagonal
  int candidates = 5;      // states that are scored
  int scoring_rounds = 3;  // sets of metric.num_grasps grasps that score them
  ObjectiveOptions objective;
};
void Bind(OptionTable* table, SearchOptions* options);  // keys "search.*"

// The mesh must be a solid (failure otherwise, and nothing is moved). The result depends on the
// mesh, the options and the stream only. result.iterations counts steps, result.moved is 0 when the
// original was kept.
PerturbResult PerturbBySearch(const TriangleMesh& mesh, const MetricOptions& metric,
                              const SearchOptions& options, RngStream* rng,
                              const ProgressFn& progress = nullptr);

}  // namespace antigrasp
