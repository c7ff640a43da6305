#include "bench/bench_objects.h"

#include "antigrasp/datasets/prior_set.h"
#include "antigrasp/quality/metric_options.h"
#include "antigrasp/sdf/marching_cubes.h"

namespace antigrasp::bench {

std::vector<TriangleMesh> RemeshedCylinders(int count, int resolution) {
  PriorSetOptions options;
  options.count = count;
  options.resolution = resolution;
  std::vector<TriangleMesh> meshes;
  for (const SdfGrid& grid : MakePriorSet(options).grids) meshes.push_back(MarchingCubes(grid));
  return meshes;
}

TriangleMesh InMetres(const TriangleMesh& mesh) {
  const double scale = MetricOptions{}.object_min_extent / Bounds(mesh).Extent().minCoeff();
  return Transformed(mesh, scale, Eigen::Vector3d::Zero());
}

}  // namespace antigrasp::bench
