#include "antigrasp/mesh/polygon_soup.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <numeric>

#include "antigrasp/core/rng.h"
#include "antigrasp/mesh/inspect.h"
#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

// The triangles of the polygon over all given points, in order.
TriangleMesh Triangulated(const std::vector<Eigen::Vector3d>& points) {
  std::vector<std::int32_t> polygon(points.size());
  std::iota(polygon.begin(), polygon.end(), 0);
  return {points, TriangulatedPolygon(points, polygon)};
}

double PolygonArea(const std::vector<Eigen::Vector3d>& points) {
  Eigen::Vector3d twice = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) {
    twice += points[i].cross(points[(i + 1) % points.size()]);
  }
  return 0.5 * twice.norm();
}

void ExpectProper(const std::vector<Eigen::Vector3d>& points) {
  const TriangleMesh mesh = Triangulated(points);
  const MeshReport report = Inspect(mesh);
  EXPECT_EQ(mesh.faces.size(), points.size() - 2);
  EXPECT_EQ(report.degenerate_faces, 0);
  EXPECT_TRUE(report.oriented);
  EXPECT_EQ(report.boundary_edges, static_cast<int>(points.size()));
  // No overlap: the parts add up to the whole.
  EXPECT_NEAR(report.area, PolygonArea(points), 1e-9 * report.area);
}

TEST(TriangulatedPolygon, ConvexPolygonsKeepTheirAreaAndWinding) {
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 100; ++i) {
    const double u = 2.0 * std::numbers::pi * i / 100;
    points.push_back({std::cos(u), 5.0, -std::sin(u)});
  }
  ExpectProper(points);
}

TEST(TriangulatedPolygon, ConcavePolygonsStayInsideTheirOutline) {
  ExpectProper({{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {1, 0.5, 0}, {0, 2, 0}});           // M
  ExpectProper({{0, 0, 1}, {3, 0, 1}, {3, 1, 1}, {1, 1, 1}, {1, 3, 1}, {0, 3, 1}});  // L
  std::vector<Eigen::Vector3d> star;
  for (int i = 0; i < 40; ++i) {
    const double u = 2.0 * std::numbers::pi * i / 40, r = i % 2 == 0 ? 1.0 : 0.2;
    star.push_back({0.0, r * std::cos(u), r * std::sin(u)});
  }
  ExpectProper(star);
}

TEST(TriangulatedPolygon, CornersOnAStraightEdgeGiveNoEmptyTriangles) {
  ExpectProper(
      {{0, 0, 0}, {0.25, 0, 0}, {0.5, 0, 0}, {1, 0, 0}, {1, 0.5, 0}, {1, 1, 0}, {0, 1, 0}});
}

TEST(TriangulatedPolygon, RandomStarShapedPolygonsInSpaceAreCoveredOnce) {
  for (int trial = 0; trial < 100; ++trial) {
    RngStream rng(3, "polygon", trial);
    const Eigen::Matrix3d turn =
        Eigen::Quaterniond(rng.Normal(), rng.Normal(), rng.Normal(), rng.Normal())
            .normalized()
            .toRotationMatrix();
    std::vector<Eigen::Vector3d> points;
    const int n = 4 + static_cast<int>(rng.Below(30));
    for (int i = 0; i < n; ++i) {
      const double u = 2.0 * std::numbers::pi * i / n, r = rng.Uniform(0.1, 1.0);
      points.push_back(turn * Eigen::Vector3d(r * std::cos(u), r * std::sin(u), 0.0));
    }
    ExpectProper(points);
  }
}

TEST(TriangulatedPolygon, AnyListOfCornersGivesTwoTrianglesLess) {
  EXPECT_EQ(Triangulated({{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}}).faces.size(),
            2u);  // crossed
  EXPECT_EQ(Triangulated(std::vector<Eigen::Vector3d>(5, {1, 2, 3})).faces.size(), 3u);
}

TEST(ToTriangleMesh, MergesExactlyEqualPositionsOnly) {
  PolygonSoup soup;
  soup.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-0.0, 0, 0}, {0, 1, 0}, {-1, 0, 1e-300}};
  soup.corners = {0, 1, 2, 3, 4, 5};
  soup.ends = {3, 6};
  const TriangleMesh mesh = ToTriangleMesh(soup, "x");
  EXPECT_EQ(mesh.vertices,
            (std::vector<Eigen::Vector3d>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 1e-300}}));
  EXPECT_EQ(mesh.faces[1], (std::array<std::int32_t, 3>{0, 2, 3}));
}

}  // namespace
}  // namespace antigrasp
