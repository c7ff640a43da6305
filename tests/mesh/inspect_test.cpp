#include "antigrasp/mesh/inspect.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <numbers>

#include "antigrasp/core/rng.h"
#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

TriangleMesh MoebiusStrip(int n) {
  TriangleMesh mesh;
  for (int i = 0; i < n; ++i) {
    const double u = 2.0 * std::numbers::pi * i / n;
    for (const double t : {-0.3, 0.3}) {
      const double r = 1.0 + t * std::cos(0.5 * u);
      mesh.vertices.push_back({r * std::cos(u), r * std::sin(u), t * std::sin(0.5 * u)});
    }
    // The last quad joins the strip to its start upside down.
    const bool seam = i + 1 == n;
    const int a = 2 * i, b = 2 * i + 1, c = seam ? 0 : 2 * i + 3, d = seam ? 1 : 2 * i + 2;
    mesh.faces.push_back({a, d, c});
    mesh.faces.push_back({a, c, b});
  }
  return mesh;
}

TEST(Inspect, EveryPlainShapeIsASolid) {
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(1.1, Eigen::Vector3d(3, 1, 2).normalized()).toRotationMatrix();
  for (const TriangleMesh& shape :
       {shapes::Sphere(1.0, 3), shapes::Cube(), shapes::Box({1, 5, 0.1}), shapes::Tetrahedron(),
        shapes::Torus(1.0, 0.3, 24, 12), shapes::Cylinder(0.3, 1.0, 17)}) {
    for (const TriangleMesh& mesh : {shape, shapes::Rotated(shape, turn)}) {
      const MeshReport report = Inspect(mesh);
      EXPECT_TRUE(report.IsSolid()) << WhyNotSolid(report);
      EXPECT_EQ(WhyNotSolid(report), "");
      EXPECT_TRUE(report.orientable && report.oriented);
      EXPECT_EQ(report.boundary_edges, 0);
      EXPECT_EQ(report.nonmanifold_edges, 0);
      EXPECT_DOUBLE_EQ(report.volume, Volume(mesh));
      EXPECT_DOUBLE_EQ(report.area, SurfaceArea(mesh));
    }
  }
}

TEST(Inspect, GenusCountsTheHandles) {
  EXPECT_EQ(Inspect(shapes::Sphere(1.0, 2)).genus, 0);
  EXPECT_EQ(Inspect(shapes::Torus(1.0, 0.3, 16, 8)).genus, 1);
  // Unused vertices are no part of the surface.
  TriangleMesh torus = shapes::Torus(1.0, 0.3, 16, 8);
  torus.vertices.push_back({9, 9, 9});
  EXPECT_EQ(Inspect(torus).genus, 1);
}

TEST(Inspect, AnInsideOutSphereIsClosedButNotOutward) {
  const MeshReport report = Inspect(shapes::Inverted(shapes::Sphere(1.0, 2)));
  EXPECT_TRUE(report.closed && report.manifold && report.oriented);
  EXPECT_FALSE(report.outward);
  EXPECT_LT(report.volume, 0.0);
  EXPECT_EQ(WhyNotSolid(report), "inside-out: volume not positive");
}

TEST(Inspect, AMissingFaceLeavesThreeBoundaryEdges) {
  TriangleMesh mesh = shapes::Sphere(1.0, 2);
  mesh.faces.pop_back();
  const MeshReport report = Inspect(mesh);
  EXPECT_FALSE(report.closed || report.manifold || report.outward || report.IsSolid());
  EXPECT_TRUE(report.oriented);
  EXPECT_EQ(report.boundary_edges, 3);
  EXPECT_EQ(WhyNotSolid(report), "open: 3 boundary edges");
  EXPECT_EQ(Inspect(shapes::FlatSquare()).boundary_edges, 4);
}

TEST(Inspect, AMoebiusStripIsNotOrientableAndACylinderStripIs) {
  const MeshReport strip = Inspect(MoebiusStrip(20));
  EXPECT_FALSE(strip.orientable);
  EXPECT_FALSE(strip.oriented);
  EXPECT_FALSE(strip.self_intersecting);
  EXPECT_EQ(strip.components, 1);
  EXPECT_EQ(strip.boundary_edges, 40);
}

TEST(Inspect, OneTurnedFaceMakesTheWindingInconsistentButStaysOrientable) {
  TriangleMesh mesh = shapes::Sphere(1.0, 1);
  std::swap(mesh.faces[7][0], mesh.faces[7][1]);
  const MeshReport report = Inspect(mesh);
  EXPECT_TRUE(report.closed && report.orientable);
  EXPECT_FALSE(report.oriented || report.outward);
  EXPECT_EQ(WhyNotSolid(report), "winding not consistent: neighbouring faces disagree");
}

// Two tetrahedra on the vertices 0..3 and 4..7 with some of the latter replaced.
TriangleMesh TetrahedraSharing(int vertices) {
  TriangleMesh mesh = shapes::Tetrahedron();
  const TriangleMesh other =
      shapes::Rotated(shapes::Tetrahedron(),
                      Eigen::AngleAxisd(std::numbers::pi, Eigen::Vector3d::UnitX()).matrix());
  // Turned by 180 degrees about x it meets the first one in the edge from 0 to e_x only.
  const std::array<int, 4> place{0, vertices > 1 ? 1 : 4, 5, 6};
  mesh.vertices.resize(7, Eigen::Vector3d::Zero());
  for (int i = 0; i < 4; ++i) mesh.vertices[place[i]] = other.vertices[i];
  if (vertices == 1) mesh.vertices[4] = {-1, 0, 0};
  for (const auto& f : other.faces) mesh.faces.push_back({place[f[0]], place[f[1]], place[f[2]]});
  return mesh;
}

TEST(Inspect, TetrahedraSharingAnEdgeAreNotManifold) {
  const MeshReport report = Inspect(TetrahedraSharing(2));
  EXPECT_FALSE(report.closed || report.manifold || report.IsSolid());
  EXPECT_EQ(report.nonmanifold_edges, 1);
  EXPECT_EQ(report.boundary_edges, 0);
  EXPECT_FALSE(report.self_intersecting);
  EXPECT_EQ(WhyNotSolid(report), "non-manifold: 1 edge with more than two faces");
}

TEST(Inspect, TetrahedraSharingAVertexAreClosedButNotManifold) {
  const MeshReport report = Inspect(TetrahedraSharing(1));
  EXPECT_TRUE(report.closed);
  EXPECT_FALSE(report.manifold || report.IsSolid());
  EXPECT_EQ(report.components, 2);
  EXPECT_EQ(WhyNotSolid(report), "non-manifold: parts touch in a single vertex");
}

TEST(Inspect, ComponentsAreCountedAndEachMustFaceOutward) {
  const TriangleMesh far = Transformed(shapes::Cube(), 1.0, {5, 0, 0});
  const MeshReport two = Inspect(shapes::Joined(shapes::Cube(), far));
  EXPECT_EQ(two.components, 2);
  EXPECT_TRUE(two.outward);
  EXPECT_EQ(WhyNotSolid(two), "disjoint pieces: 2");
  // The sum of the volumes is positive, the second cube is not.
  const TriangleMesh small = Transformed(far, 0.5, Eigen::Vector3d::Zero());
  EXPECT_FALSE(Inspect(shapes::Joined(shapes::Cube(), shapes::Inverted(small))).outward);
}

TEST(Inspect, ABowTieIntersectsItself) {
  const MeshReport crossing =
      Inspect(shapes::Joined(shapes::Cube(), Transformed(shapes::Cube(), 1.0, {0.5, 0.5, 0.5})));
  EXPECT_TRUE(crossing.self_intersecting);
  // One vertex of a tetrahedron pulled through its opposite face of a stitched pair.
  TriangleMesh spike = shapes::Sphere(1.0, 2);
  spike.vertices[0] = -3.0 * spike.vertices[0];
  const MeshReport report = Inspect(spike);
  EXPECT_TRUE(report.closed && report.manifold);
  EXPECT_TRUE(report.self_intersecting);
  EXPECT_EQ(WhyNotSolid(report), "self-intersecting");
  EXPECT_FALSE(Inspect(spike, false).self_intersecting);
}

TEST(Inspect, FacesFoldedOntoEachOtherIntersectAndFlatNeighboursDoNot) {
  // Two triangles on one edge in one plane: side by side, then folded back.
  TriangleMesh pair{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.5, -1, 0}}, {{{0, 1, 2}, {1, 0, 3}}}};
  EXPECT_FALSE(Inspect(pair).self_intersecting);
  pair.vertices[3] = {0.5, 1, 0};
  EXPECT_TRUE(Inspect(pair).self_intersecting);
  // Through a common vertex.
  const TriangleMesh fan{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.5, 0.2, 1}, {0.5, 0.2, -1}},
                         {{{0, 1, 2}, {0, 3, 4}}}};
  EXPECT_TRUE(Inspect(fan).self_intersecting);
}

TEST(Inspect, TouchingWithoutCrossingIsASelfIntersection) {
  const TriangleMesh touching =
      shapes::Joined(shapes::Cube(), Transformed(shapes::Cube(), 0.5, {0.75, 0.0, 0.0}));
  EXPECT_TRUE(Inspect(touching).self_intersecting);
}

TEST(Inspect, FacesWithoutAreaAreDegenerate) {
  TriangleMesh mesh = shapes::Cube();
  mesh.faces.push_back({0, 1, 1});
  EXPECT_EQ(Inspect(mesh).degenerate_faces, 1);
  const TriangleMesh line{{{0, 0, 0}, {0.1, 0.1, 0.1}, {0.3, 0.3, 0.3}}, {{{0, 1, 2}}}};
  EXPECT_EQ(Inspect(line).degenerate_faces, 1);
  const TriangleMesh needle{{{0, 0, 0}, {1, 0, 0}, {0.5, 1e-9, 0}}, {{{0, 1, 2}}}};
  EXPECT_EQ(Inspect(needle).degenerate_faces, 0);
}

TEST(Inspect, SurvivesEveryBrokenInput) {
  EXPECT_EQ(WhyNotSolid(Inspect(TriangleMesh{})), "empty: no faces");
  TriangleMesh mesh = shapes::Cube();
  mesh.vertices[3].y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(Inspect(mesh).finite);
  EXPECT_TRUE(WhyNotSolid(Inspect(mesh)).starts_with("not finite"));
  mesh = shapes::Cube();
  mesh.vertices[3].y() = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(Inspect(mesh).finite);
  for (const std::int32_t index : {8, -1, std::numeric_limits<std::int32_t>::max()}) {
    mesh = shapes::Cube();
    mesh.faces[5][1] = index;
    EXPECT_FALSE(Inspect(mesh).finite);
    EXPECT_FALSE(Inspect(mesh).IsSolid());
  }
  mesh = Transformed(shapes::Cube(), 1e200, Eigen::Vector3d::Zero());
  EXPECT_FALSE(Inspect(mesh).IsSolid());  // the volume overflows
}

TEST(Inspect, RandomFaceSoupsAreDescribedAndNeverSolid) {
  for (int trial = 0; trial < 300; ++trial) {
    RngStream rng(7, "soup", trial);
    TriangleMesh soup;
    for (std::uint64_t i = 0, n = 1 + rng.Below(8); i < n; ++i) {
      // Few distinct places, so that equal and collinear points are common.
      soup.vertices.push_back({static_cast<double>(rng.Below(3)), static_cast<double>(rng.Below(3)),
                               static_cast<double>(rng.Below(2))});
    }
    const auto pick = [&] { return static_cast<std::int32_t>(rng.Below(soup.vertices.size())); };
    for (std::uint64_t i = 0, n = rng.Below(12); i < n; ++i) {
      soup.faces.push_back({pick(), pick(), pick()});
    }
    const MeshReport report = Inspect(soup);
    EXPECT_TRUE(report.finite);
    EXPECT_EQ(report.IsSolid(), WhyNotSolid(report).empty());
    EXPECT_LE(report.components, static_cast<int>(soup.faces.size()));
    // Edge uses: 3 per face = boundary + 2 * ordinary + at least 3 * non-manifold.
    EXPECT_GE(3 * static_cast<int>(soup.faces.size()),
              report.boundary_edges + 3 * report.nonmanifold_edges);
  }
}

}  // namespace
}  // namespace antigrasp
