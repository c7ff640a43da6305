#pragma once

#include "antigrasp/core/parallel.h"
#include "antigrasp/core/rng.h"
#include "antigrasp/perturb/pair_sampler.h"
#include "antigrasp/perturb/perturbation.h"

namespace antigrasp {

// Section IV-C. A mesh of more than `max_faces` faces is decimated first. In each iteration: a pair
// of antipodal faces with phi < psi, turned by +theta and -theta, theta = beta (psi - phi), about
// the axis orthogonal to both normals, each about its own centroid; their corners go with them.
struct RotationOptions {
  double beta = 0.075;               // paper: 0.01, 0.075, 0.3
  int max_faces = 350;               // d; 0 = never decimate
  int iterations = 0;                // 0 = iterations_per_face times the number of faces
  double iterations_per_face = 1.0;  // after decimation
  PairDraw pairs = PairDraw::kUniform;
  // The guard takes back a rotation after which a face around it is turned further than this from
  // how the decimated mesh had it, degrees.
  double max_turn = 60.0;
};
void Bind(OptionTable* table, RotationOptions* options);  // keys "rotation.*"

// Single thread; 350 iterations take 20 ms, decimation 25-130 ms. The mesh must be a solid.
PerturbResult PerturbByRotation(const TriangleMesh& mesh, const PairLimits& pairs,
                                const PerturbOptions& common, const RotationOptions& options,
                                RngStream* rng, const ProgressFn& progress = nullptr);

// The unit axis orthogonal to both normals. Where the normals are parallel every axis across them
// is: the one across the line between the centroids then (so that it moves with the object), and
// the first face's longest edge where that line runs along the normals.
Eigen::Vector3d RotationAxis(const FaceShape& first, const FaceShape& second);

// The corners of both faces after `first` turned by theta and `second` by -theta about `axis`
// through their centroids (right hand). A corner that both faces hold makes both moves.
std::vector<VertexMove> RotateFaces(const EditableMesh& mesh, std::int32_t first,
                                    std::int32_t second, const Eigen::Vector3d& axis, double theta);

}  // namespace antigrasp
