#include "antigrasp/mesh/point_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "tests/support/random_draws.h"
#include "tests/support/rippled_solid.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

constexpr auto kAll = [](const PointTree::Box&) { return true; };

TEST(PointTree, ShowsEveryPointOnceToWhoOpensEveryBox) {
  RngStream rng(1, "tree");
  for (const int count : {0, 1, 8, 9, 100, 1001}) {
    std::vector<Vector3d> points;
    for (int i = 0; i < count; ++i) points.push_back(DrawPoint(1.0, &rng));
    points.resize(static_cast<std::size_t>(count + count / 2), Vector3d(1, 2, 3));  // repeated
    std::vector<int> seen(points.size(), 0);
    PointTree(points).Search(Vector3d::Zero(), kAll, [&](std::size_t i) { ++seen[i]; });
    EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), std::ssize(points)) << count;
  }
}

TEST(PointTree, NoPointReachesFurtherThanTheBoxesAroundIt) {
  RngStream rng(2, "tree");
  std::vector<Vector3d> points;
  for (int i = 0; i < 500; ++i) {
    points.push_back(DrawPoint(1.0, &rng).cwiseProduct(Vector3d(5, 1, 0)) + Vector3d(9, 8, 7));
  }
  const PointTree tree(points);
  for (int i = 0; i < 200; ++i) {
    const Vector3d direction = DrawDirection(&rng);
    double most = -std::numeric_limits<double>::infinity();
    for (const Vector3d& p : points) most = std::max(most, p.dot(direction));
    double found = -std::numeric_limits<double>::infinity();
    tree.Search(
        Vector3d::Zero(),
        [&](const PointTree::Box& box) { return box.Reach(direction) >= most - 1e-12; },
        [&](std::size_t p) { found = std::max(found, points[p].dot(direction)); });
    EXPECT_EQ(found, most);
  }
}

TEST(PointTree, APlaneThatTouchesARoundSurfaceMeetsFewOfItsPoints) {
  // Boxes of 4 to 8 points: one where the plane touches and a few around it, whatever the number.
  RngStream rng(3, "tree");
  for (const int rings : {20, 80, 160}) {
    const std::vector<Vector3d> points = RippledSolid(rings).vertices;
    const PointTree tree(points);
    int seen = 0;
    for (int i = 0; i < 100; ++i) {
      const Vector3d direction = DrawDirection(&rng);
      double most = -std::numeric_limits<double>::infinity();
      tree.Search(
          direction, [&](const PointTree::Box& box) { return box.Reach(direction) >= most; },
          [&](std::size_t p) {
            ++seen;
            most = std::max(most, points[p].dot(direction));
          });
    }
    EXPECT_LT(seen / 100, 60) << rings << " rings";
  }
}

TEST(PointTree, BoxesNearThePlaceAskedForComeFirst) {
  std::vector<Vector3d> points;
  for (int i = 0; i < 1000; ++i) points.emplace_back(i, 0, 0);
  for (const double place : {0.0, 999.0}) {
    std::vector<std::size_t> order;
    PointTree(points).Search(Vector3d(place, 0, 0), kAll,
                             [&](std::size_t i) { order.push_back(i); });
    EXPECT_NEAR(static_cast<double>(order.front()), place, 8.0);
    EXPECT_NEAR(static_cast<double>(order.back()), 999.0 - place, 8.0);
  }
}

}  // namespace
}  // namespace antigrasp
