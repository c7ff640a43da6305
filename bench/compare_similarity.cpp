#include <CGAL/Orthogonal_k_neighbor_search.h>
#include <CGAL/Search_traits_3.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <utility>

#include "antigrasp/datasets/chamfer.h"
#include "antigrasp/datasets/surface_comparison.h"
#include "bench/bench_objects.h"
#include "bench/compare.h"
#include "bench/timing.h"

namespace antigrasp::bench {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Traits = CGAL::Search_traits_3<Kernel>;
using Search = CGAL::Orthogonal_k_neighbor_search<Traits>;
using Tree = Search::Tree;
using Points = std::vector<Kernel::Point_3>;

constexpr int kRounds = 5, kShapes = 100, kPoints = 1024;
constexpr int kPeerShapes = 5;  // of either set; the peers take long

Points PointsOf(const PointSet& set) {
  Points points;
  for (const PointSet::Block& block : set.blocks()) {
    for (std::size_t i = 0; i < block.used; ++i) {
      points.emplace_back(block.at[0][i], block.at[1][i], block.at[2][i]);
    }
  }
  return points;
}

double TreeMean(const Points& from, const Tree& to) {
  double sum = 0.0;
  for (const auto& point : from) sum += std::sqrt(Search(to, point, 1).begin()->second);
  return sum / static_cast<double>(from.size());
}

double PlainMean(const Points& from, const Points& to) {
  double sum = 0.0;
  for (const auto& a : from) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const auto& b : to) nearest = std::min(nearest, CGAL::squared_distance(a, b));
    sum += std::sqrt(nearest);
  }
  return sum / static_cast<double>(from.size());
}

// A shape as the three ways want it; trees are built beforehand.
struct Shape {
  Shape(const PointSet& points, OrientedPointSet with_normals)
      : set(points),
        oriented(std::move(with_normals)),
        plain(PointsOf(points)),
        tree(plain.begin(), plain.end()) {
    tree.build();
  }
  PointSet set;
  OrientedPointSet oriented;
  Points plain;
  Tree tree;
};

double Tree2(const Shape& a, const Shape& b) {
  return 0.5 * (TreeMean(a.plain, b.tree) + TreeMean(b.plain, a.tree));
}
double Plain2(const Shape& a, const Shape& b) {
  return 0.5 * (PlainMean(a.plain, b.plain) + PlainMean(b.plain, a.plain));
}

}  // namespace

// Two sets of 100 remeshed cylinders objects, every shape of one against every shape of the other,
// one thread.
void CompareSimilarity() {
  const std::vector<TriangleMesh> meshes = RemeshedCylinders(2 * kShapes);
  std::vector<std::unique_ptr<Shape>> shapes;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    const double length = NormalLength(1.0, Bounds(meshes[i]).Extent().norm());
    shapes.push_back(
        std::make_unique<Shape>(SurfacePoints(meshes[i], kPoints, 1, 0, i),
                                OrientedSurfacePoints(meshes[i], kPoints, 1, 0, i, length)));
  }
  static double sink = 0.0;
  const auto pairs = [&shapes](int count, const auto& distance) {
    return [&shapes, count, distance] {
      for (int i = 0; i < count; ++i) {
        for (int j = 0; j < count; ++j) {
          sink += distance(*shapes[std::size_t(i)], *shapes[std::size_t(kShapes + j)]);
        }
      }
    };
  };
  const auto ours = [](const Shape& a, const Shape& b) { return Chamfer(a.set, b.set); };
  const auto with_normals = [](const Shape& a, const Shape& b) {
    return Chamfer(a.oriented, b.oriented);
  };
  double apart = 0.0;
  for (std::size_t i = 0; i < kPeerShapes; ++i) {
    const Shape &a = *shapes[i], &b = *shapes[kShapes + i];
    apart = std::max(apart, std::abs(ours(a, b) - Tree2(a, b)) / Tree2(a, b));
  }
  std::printf("chamfer: at most %.1e from the kd-tree's, relative\n", apart);
  const std::vector<double> seconds =
      MedianSeconds({{"blocks", pairs(kShapes, ours), kShapes * kShapes},
                     {"normals", pairs(kShapes, with_normals), kShapes * kShapes},
                     {"tree", pairs(kPeerShapes, Tree2), kPeerShapes * kPeerShapes},
                     {"plain", pairs(kPeerShapes, Plain2), kPeerShapes * kPeerShapes}},
                    kRounds);
  PrintTime("chamfer_1024_points", seconds[0]);
  PrintTime("chamfer_1024_points_with_normals", seconds[1]);
  PrintTime("chamfer_1024_points_cgal_kd_tree", seconds[2]);
  PrintRatio("chamfer_without_normals_vs_with", seconds[1] / seconds[0]);
  PrintRatio("chamfer_blocks_vs_cgal_kd_tree", seconds[2] / seconds[0]);
  PrintRatio("chamfer_blocks_vs_all_points", seconds[3] / seconds[0]);
}

}  // namespace antigrasp::bench
