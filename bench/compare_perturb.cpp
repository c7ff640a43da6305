#include <Eigen/Geometry>
#include <cstdio>
#include <string>

#include "antigrasp/mesh/self_intersection.h"
#include "antigrasp/perturb/cone.h"
#include "antigrasp/perturb/random_perturbation.h"
#include "bench/bench_objects.h"
#include "bench/compare.h"
#include "bench/timing.h"

namespace antigrasp::bench {
namespace {

using Eigen::Vector3d;

constexpr int kRounds = 3;

// The test as one writes it down: the normals, then the middle direction and the 18 segments of the
// Minkowski difference, no shortcut. (The middle direction alone can only matter where the faces
// overlap along it: left out, which makes this way faster than it may be.)
bool PlainTest(const FaceShape& a, const FaceShape& b, double psi) {
  if (AntipodalityAngle(a.normal, b.normal) > 2.0 * psi) return false;
  const Cone inward(-a.normal, psi), outward(b.normal, psi);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      const Vector3d from = b.corner[j] - a.corner[i];
      for (const Vector3d& step : {Vector3d(b.corner[(j + 1) % 3] - b.corner[j]),
                                   Vector3d(a.corner[i] - a.corner[(i + 1) % 3])}) {
        const Range range = ClipToCone(from, step, inward, {0.0, 1.0});
        if (!range.empty() && !ClipToCone(from, step, outward, range).empty()) return true;
      }
    }
  }
  return false;
}

template <typename Test>
std::int64_t CountByAllPairs(const TriangleMesh& mesh, const Test& test) {
  std::vector<FaceShape> shapes;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) shapes.emplace_back(mesh, f);
  std::int64_t count = 0;
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    for (std::size_t j = i + 1; j < shapes.size(); ++j) count += test(shapes[i], shapes[j]);
  }
  return count;
}

void ComparePairs(const TriangleMesh& mesh, std::int64_t* sink) {
  const PairLimits limits;
  const AntipodalTest test(limits);
  const std::vector<double> seconds =
      MedianSeconds({{"tree", [&] { *sink += CountAntipodalPairs(mesh, limits); }},
                     {"all_pairs", [&] { *sink += CountByAllPairs(mesh, test); }},
                     {"plain",
                      [&] {
                        *sink += CountByAllPairs(mesh, [&](const FaceShape& a, const FaceShape& b) {
                          return PlainTest(a, b, limits.cone_angle);
                        });
                      }}},
                    kRounds);
  std::printf("antipodal pairs of %zu faces: %lld\n", mesh.faces.size(),
              static_cast<long long>(CountAntipodalPairs(mesh, limits)));
  PrintTime("antipodal_pairs", seconds[0]);
  PrintRatio("antipodal_pairs_tree_vs_all_pairs", seconds[1] / seconds[0]);
  PrintRatio("antipodal_pairs_tree_vs_plain_all_pairs", seconds[2] / seconds[0]);
}

double SecondsPerIteration(const TriangleMesh& mesh, int iterations, bool checked,
                           std::int64_t* sink) {
  RandomPerturbOptions options;
  PerturbOptions common;
  common.unchecked = !checked;
  const auto run = [&](int count) {
    return [&, count] {
      RngStream rng(1, "perturb");
      options.iterations = count;
      *sink += PerturbRandomly(mesh, {}, common, options, &rng).moved;
    };
  };
  // What begins and ends a run, checks of the whole mesh above all, is taken off.
  const std::vector<double> seconds =
      MedianSeconds({{"long", run(iterations)}, {"short", run(1)}}, kRounds);
  return (seconds[0] - seconds[1]) / (iterations - 1);
}

// One iteration of IV-B as it is, and if F_a were listed or the whole mesh tested in each.
void CompareIterations(const TriangleMesh& mesh, std::int64_t* sink) {
  const double iteration = SecondsPerIteration(mesh, 5000, true, sink);
  const double unchecked = SecondsPerIteration(mesh, 5000, false, sink);
  const std::vector<double> seconds = MedianSeconds(
      {{"list", [&] { *sink += static_cast<std::int64_t>(AntipodalPairs(mesh, {}).size()); }},
       {"self_intersection", [&] { *sink += SelfIntersects(mesh); }}},
      kRounds);
  PrintTime("random_iteration", iteration);
  PrintTime("random_iteration_unchecked", unchecked);
  PrintRatio("random_run_vs_listing_pairs_every_time", (iteration + seconds[0]) / iteration);
  PrintRatio("random_run_vs_testing_the_whole_mesh_every_time",
             (unchecked + seconds[1]) / iteration);
}

// The same object from grids of 16, 32 and 128 nodes a side: 700 to 50,000 faces.
void CompareSizes(std::int64_t* sink) {
  std::vector<double> iteration;
  for (const int resolution : {16, 32, 128}) {
    const TriangleMesh mesh = RemeshedCylinders(1, resolution).front();
    const std::string faces = std::to_string(mesh.faces.size());
    iteration.push_back(SecondsPerIteration(mesh, 3000, true, sink));
    PrintTime("random_iteration_" + faces + "_faces", iteration.back());
    PrintTime("antipodal_pairs_" + faces + "_faces",
              Seconds([&] { *sink += CountAntipodalPairs(mesh, {}); }));
  }
  PrintRatio("random_iteration_smallest_vs_largest_mesh", iteration.front() / iteration.back());
}

}  // namespace

void ComparePerturb() {
  static std::int64_t sink = 0;
  const TriangleMesh mesh = RemeshedCylinders(1).front();
  ComparePairs(mesh, &sink);
  CompareIterations(mesh, &sink);
  CompareSizes(&sink);
}

}  // namespace antigrasp::bench
