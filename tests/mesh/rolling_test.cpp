#include "antigrasp/mesh/rolling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "antigrasp/mesh/convex_hull.h"
#include "antigrasp/mesh/stable_poses.h"
#include "tests/mesh/plain_rolling.h"
#include "tests/support/random_draws.h"
#include "tests/support/rippled_solid.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

// Points whose hulls roll in every way there is: few facets and many, stretched ones, flat facets
// of many corners, corners rounded to float as in an STL file, facets at more than a right angle,
// corners cut off so close that the object turns on the spot.
std::vector<Vector3d> DrawSolid(int kind, RngStream* rng) {
  const Vector3d stretch(1.0, rng->Uniform(0.2, 1.0), rng->Uniform(0.1, 3.0));
  const auto uniform = [rng](double low, double high) { return rng->Uniform(low, high); };
  const int count = static_cast<int>(uniform(6, 80));
  const double taper = uniform(0.5, 1.0);
  std::vector<Vector3d> points;
  for (int i = 0; i < count; ++i) {
    const double turn = 2.0 * std::numbers::pi * i / count;
    const Vector3d rim(std::cos(turn), std::sin(turn), 0.0);
    if (kind == 0) {
      points.push_back(DrawPoint(1.0, rng).cwiseProduct(stretch));
    } else if (kind == 1) {
      points.push_back(DrawDirection(rng).cwiseProduct(stretch));  // every one a corner
    } else if (kind == 2) {                                        // a dish, thin or tall
      points.push_back(rim);
      points.push_back(taper * rim + Vector3d(0, 0, 0.1 * stretch.z()));
    } else if (kind == 3) {  // a grid: flat facets, edges with corners along them
      points.push_back(Vector3d(std::floor(uniform(0, 3)), std::floor(uniform(0, 4)),
                                std::floor(uniform(0, 6))));
    } else if (kind == 4) {  // a few corners, each cut off
      if (i % 4 == 0) points.push_back(DrawPoint(1.0, rng).cwiseProduct(stretch));
      points.push_back(points.back() + DrawPoint(2e-5, rng));
    } else {  // stacked rings, as a bottle
      points.push_back((1.0 + 0.3 * std::sin(3.0 * (i % 7))) * rim + Vector3d(0, 0, i % 7));
    }
  }
  const Eigen::Matrix3d rotation = DrawRotation(rng);
  for (Vector3d& p : points) {
    p = rotation * p;
    if (uniform(0, 1) < 0.5) p = p.cast<float>().cast<double>();
  }
  return points;
}

TEST(Rolling, EndsWhereLookingAtEveryCornerAndFacetEnds) {
  int rolled = 0;
  for (int object = 0; object < 500; ++object) {
    RngStream rng(1, "rolling", static_cast<std::uint64_t>(object));
    const TriangleMesh mesh = ConvexHull(DrawSolid(object % 6, &rng));
    if (mesh.faces.empty()) continue;
    // Off the middle, as that of a hollow object, so that more of it rolls.
    const Vector3d com = CenterOfMass(mesh) + 0.2 * Bounds(mesh).Extent().cwiseProduct(Vector3d(
                                                        rng.Uniform(-1, 1), rng.Uniform(-1, 1), 0));
    const FacetedHull hull = MakeFacetedHull(mesh, com);
    const std::vector<std::size_t> resting = RestingFacets(hull);
    const std::vector<std::size_t> plain = PlainRestingFacets(hull);
    ASSERT_EQ(resting, plain) << "object " << object;
    for (std::size_t f = 0; f < resting.size(); ++f) rolled += resting[f] != f ? 1 : 0;
    std::vector<double> probability(hull.facets.size(), 0.0);
    for (std::size_t f = 0; f < plain.size(); ++f) {
      probability[plain[f]] += hull.facets[f].solid_angle / (4.0 * std::numbers::pi);
    }
    for (const StablePose& pose : StablePoses(mesh, com)) {
      double least = 1.0;
      for (std::size_t f = 0; f < probability.size(); ++f) {
        if ((hull.facets[f].normal + pose.table_from_object.row(2).transpose()).norm() < 1e-9) {
          least = std::min(least, std::abs(probability[f] - pose.probability));
        }
      }
      EXPECT_LT(least, 1e-12) << "object " << object;
    }
  }
  EXPECT_GT(rolled, 5000);
}

TEST(Rolling, EndsThereOnARippledSolidToo) {
  const TriangleMesh mesh = RippledSolid(20);
  const FacetedHull hull = MakeFacetedHull(mesh, CenterOfMass(mesh));
  ASSERT_EQ(hull.mesh.faces.size(), 1520u);  // 4 * 20 * 19: every vertex is on the hull
  const std::vector<std::size_t> resting = RestingFacets(hull);
  EXPECT_EQ(resting, PlainRestingFacets(hull));
  EXPECT_GT(
      std::count_if(resting.begin(), resting.end(), [&](std::size_t f) { return resting[f] == f; }),
      10);
}

}  // namespace
}  // namespace antigrasp
