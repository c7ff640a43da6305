#pragma once

#include "antigrasp/core/parallel.h"
#include "antigrasp/core/rng.h"
#include "antigrasp/perturb/perturbation.h"

namespace antigrasp {

// Section IV-A, for meshes of some hundred faces. In each iteration F_a is computed and each vertex
// of its faces tries six random unit directions with one fixed step; the place where the sum of the
// antipodality angles over the pairs of F_a that hold a face around the vertex is largest is taken.
struct ExhaustiveOptions {
  int iterations = 64;  // paper, figure 1
  double step = 0.1;    // delta, percent of the bounding-box diagonal
  int directions = 6;
  bool only_if_better = false;  // stay where no direction raises the sum (the paper always moves)
};
void Bind(OptionTable* table, ExhaustiveOptions* options);  // keys "exhaustive.*"

// Ends early when no pair of F_a has phi < psi. The guard takes the best place that it allows. With
// common.history |F_a| is noted in every iteration. Single thread; an iteration costs about
// |F_a| x 20 angles: 3 ms at 36 faces, 1 s at 2,500. The mesh must be a solid.
PerturbResult PerturbExhaustively(const TriangleMesh& mesh, const PairLimits& pairs,
                                  const PerturbOptions& common, const ExhaustiveOptions& options,
                                  RngStream* rng, const ProgressFn& progress = nullptr);

}  // namespace antigrasp
