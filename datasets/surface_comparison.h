#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "antigrasp/core/parallel.h"
#include "antigrasp/core/work_share.h"
#include "antigrasp/datasets/set_comparison.h"
#include "antigrasp/mesh/triangle_mesh.h"

namespace antigrasp {

struct SurfaceComparisonOptions {
  int points = 1024;  // a shape
  // The length of OrientedPointSet, by the radius of the ball that has the reference's mean
  // diagonal. At 1 a ball's normals lie as far from each other as its points, so that neither
  // rules: the length that gives both the same variance. 0: no comparison with normals.
  double normals = 1.0;
  std::uint64_t seed = 1;
  int threads = 0;             // 0 = all; the result does not depend on it
  WorkShare* share = nullptr;  // whose ranks measure the distances together
};

// Whether samples are copies of what their generator was trained on: distances to the nearest
// training shape.
struct Memorisation {
  double samples = 0.0;    // mean over the samples
  double reference = 0.0;  // mean over the reference, which nobody copied
  double nearer = 0.0;     // share of samples nearer than the reference's median; 0.5 = none copied
};

// What one set looks like by itself.
struct SetLook {
  double size = 0.0;                // mean diagonal of the bounding boxes
  double roughness = 0.0;           // mean of MeanDihedralAngle, degrees
  double flat = 0.0, crease = 0.0;  // mean shares of DihedralAngles
  double vendi = 0.0;  // VendiScore without floors, at half the reference's median distance
  // Mean Chamfer distance between two samplings of one shape: what smaller distances than this say
  // is chance.
  double floor = 0.0;
};

struct SurfaceComparison {
  SetComparison sets;                    // of the distances as they are
  SpreadComparison spread;               // of the distances without the floors of the sampling
  std::optional<SetComparison> normals;  // of the distances of points with their normals
  SetLook samples, reference;
  double dihedral_distance = 0.0;            // DihedralDistance of the sets' mean angles, degrees
  std::optional<Memorisation> memorisation;  // with training shapes
};

// The numbers of the shapes' random streams, no two of a set the same; a set without any takes the
// shapes' places in it.
struct SurfaceStreams {
  std::vector<std::uint64_t> samples, reference, training;
};

// The length of normals: of `weight` 1 and a mean diagonal of the bounding boxes.
double NormalLength(double weight, double diagonal);

// Names a phase of the work and gets its progress.
using PhaseFn = std::function<ProgressFn(const std::string&)>;

// Samples against a reference of the same size (at least two), by Chamfer distances between points
// of their surfaces, in the unit of the meshes and as they lie: nothing is moved, turned or scaled.
// Every mesh needs an area. `training` may be empty. Cost: (2 n)^2 / 2 Chamfer distances, as many
// with normals, and 2 n for each training shape. Without numbers on a rank that helps.
SurfaceComparison CompareSurfaces(const std::vector<TriangleMesh>& samples,
                                  const std::vector<TriangleMesh>& reference,
                                  const std::vector<TriangleMesh>& training,
                                  const SurfaceComparisonOptions& options,
                                  const PhaseFn& phase = nullptr,
                                  const SurfaceStreams& streams = {});

}  // namespace antigrasp
