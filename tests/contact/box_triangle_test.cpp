#include "antigrasp/contact/box_triangle.h"

#include <gtest/gtest.h>

#include <cmath>

#include "antigrasp/core/rng.h"
#include "tests/contact/clip_oracle.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;
using Triangle = std::array<Vector3d, 3>;

Vector3d RandomPoint(double size, RngStream* rng) {
  return {rng->Uniform(-size, size), rng->Uniform(-size, size), rng->Uniform(-size, size)};
}

// Around, across and inside boxes; one in four a needle, one in eight without area, one in sixteen
// a point.
Triangle RandomTriangle(int i, RngStream* rng) {
  const Vector3d at = RandomPoint(1.2, rng);
  const double size = std::pow(10.0, rng->Uniform(-3.0, 0.7));
  Triangle triangle;
  for (Vector3d& corner : triangle) corner = at + RandomPoint(size, rng);
  const double along = rng->Uniform(-1.0, 2.0);
  const Vector3d on_edge = triangle[0] + along * (triangle[1] - triangle[0]);
  if (i % 4 == 1) triangle[2] = on_edge + 1e-13 * RandomPoint(1.0, rng);
  if (i % 8 == 2) triangle[2] = on_edge;
  if (i % 16 == 3) triangle[1] = triangle[2] = triangle[0];
  return triangle;
}

TEST(BoxMeetsTriangle, AgreesWithClippingOnRandomNeedlesPointsAndTriangles) {
  RngStream rng(1, "box triangle");
  const double slack = 1e-9;
  int meets = 0, close = 0;
  const int count = 100000;
  for (int i = 0; i < count; ++i) {
    const Triangle triangle = RandomTriangle(i, &rng);
    const Vector3d half = RandomPoint(1.0, &rng).cwiseAbs() + Vector3d::Constant(0.01);
    const Vector3d grown = half + Vector3d::Constant(slack);
    const Vector3d shrunk = half - Vector3d::Constant(slack);
    const bool surely = ClippedTriangleRemains(triangle, -shrunk, shrunk);
    const bool possibly = ClippedTriangleRemains(triangle, -grown, grown);
    const bool answer = BoxMeetsTriangle(half, triangle);
    meets += answer ? 1 : 0;
    close += surely != possibly ? 1 : 0;
    EXPECT_TRUE(answer || !surely) << i;
    EXPECT_TRUE(possibly || !answer) << i;
  }
  EXPECT_GT(meets, count / 10);
  EXPECT_LT(meets, count / 2);
  EXPECT_LT(close, 10);
}

TEST(BoxMeetsTriangle, SeesContactThroughCornersEdgesAndFaces) {
  const Vector3d half(1.0, 2.0, 3.0);
  EXPECT_TRUE(BoxMeetsTriangle(half, {{{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}}}));  // inside
  EXPECT_TRUE(BoxMeetsTriangle(half, {{{-9, -9, 0}, {9, -9, 0}, {0, 20, 0}}}));  // around
  EXPECT_TRUE(BoxMeetsTriangle(half, {{{1, 0, 0}, {2, 0, 0}, {2, 1, 0}}}));      // on a face
  EXPECT_TRUE(BoxMeetsTriangle(half, {{{1, 2, 3}, {4, 4, 4}, {5, 4, 4}}}));      // on a corner
  EXPECT_TRUE(BoxMeetsTriangle(half, {{{2, 1, -9}, {0, 3, -9}, {1, 2, 9}}}));    // on an edge
  EXPECT_FALSE(BoxMeetsTriangle(half, {{{1.001, 0, 0}, {2, 0, 0}, {2, 1, 0}}}));
  // Inside all three slabs' overlaps of its bounding box, but past a corner or an edge.
  EXPECT_FALSE(BoxMeetsTriangle(half, {{{2.1, 1, -9}, {0, 3.1, -9}, {1.1, 2.1, 9}}}));
  EXPECT_FALSE(BoxMeetsTriangle({1, 1, 1}, {{{3.01, 0, 0}, {0, 3.01, 0}, {0, 0, 3.01}}}));
  EXPECT_TRUE(BoxMeetsTriangle({1, 1, 1}, {{{2.99, 0, 0}, {0, 2.99, 0}, {0, 0, 2.99}}}));
}

}  // namespace
}  // namespace antigrasp
