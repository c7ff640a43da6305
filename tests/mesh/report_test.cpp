#include <gtest/gtest.h>

#include <functional>
#include <utility>

#include "antigrasp/mesh/inspect.h"
#include "tests/support/shapes.h"

// Every number and every verdict of a MeshReport.
namespace antigrasp {
namespace {

using Eigen::Vector3d;

TEST(MeshReport, HasEveryNumberOfALopsidedSolid) {
  // A box of 1 x 2 x 3 away from the origin: 6, 2 (2 + 3 + 6) = 22, and its middle.
  const MeshReport box = Inspect(Transformed(shapes::Box({1, 2, 3}), 1.0, {10, -20, 30}));
  EXPECT_DOUBLE_EQ(box.volume, 6.0);
  EXPECT_DOUBLE_EQ(box.area, 22.0);
  EXPECT_TRUE(box.center_of_mass.isApprox(Vector3d(10, -20, 30), 1e-15));
  EXPECT_TRUE(box.finite && box.closed && box.manifold && box.orientable && box.oriented);
  EXPECT_TRUE(box.outward);
  EXPECT_FALSE(box.self_intersecting);
  EXPECT_EQ(box.components, 1);
  EXPECT_EQ(box.degenerate_faces + box.boundary_edges + box.nonmanifold_edges + box.genus, 0);
}

// A tetrahedron over legs 4, 8, 12: its mass is at a quarter of each, the middle of its box at
// half.
TEST(MeshReport, CenterOfMassIsNotTheMiddleOfTheBox) {
  const TriangleMesh corner{{{0, 0, 0}, {4, 0, 0}, {0, 8, 0}, {0, 0, 12}},
                            shapes::Tetrahedron().faces};
  const MeshReport report = Inspect(corner);
  EXPECT_TRUE(report.center_of_mass.isApprox(Vector3d(1, 2, 3), 1e-14));
  EXPECT_DOUBLE_EQ(report.volume, 64.0);
  // Three right triangles and the slope: half |(4, 8, 12)'s faces' cross| = sqrt(16^2+24^2+48^2).
  EXPECT_DOUBLE_EQ(report.area, 16.0 + 24.0 + 48.0 + 56.0);
}

TEST(MeshReport, PiecesAddUpAndHaveNoGenus) {
  const TriangleMesh torus = shapes::Torus(1.0, 0.3, 8, 6);
  const MeshReport two = Inspect(shapes::Joined(torus, Transformed(torus, 1.0, {5, 0, 0})));
  EXPECT_EQ(two.components, 2);
  EXPECT_EQ(two.genus, 0);
  EXPECT_NEAR(two.volume, 2.0 * Volume(torus), 1e-12);
}

// A torus whose second way round joins upside down: closed, manifold and one-sided. Where its
// vertices are is of no matter.
TEST(MeshReport, AKleinBottleIsClosedAndHasNoGenus) {
  constexpr int kAround = 6, kAlong = 5;
  TriangleMesh mesh;
  const auto at = [&](int i, int j) {
    if (i == kAlong) j = kAround - j;
    return i % kAlong * kAround + j % kAround;
  };
  for (int i = 0; i < kAlong; ++i) {
    for (int j = 0; j < kAround; ++j) {
      mesh.vertices.push_back({1.0 * i * i, 1.0 * j * j, 1.0 * i * j});
      mesh.faces.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.faces.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  const MeshReport report = Inspect(mesh, false);
  EXPECT_TRUE(report.closed && report.manifold);
  EXPECT_FALSE(report.orientable || report.oriented || report.outward);
  EXPECT_EQ(report.components, 1);
  EXPECT_EQ(report.genus, 0);
  EXPECT_EQ(WhyNotSolid(report), "not orientable: one-sided surface");
}

TEST(MeshReport, ThreeFacesOnOneEdgeAreNotOriented) {
  const TriangleMesh fins{{{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, -1, 0}},
                          {{{0, 1, 2}, {1, 0, 3}, {1, 0, 4}}}};
  const MeshReport report = Inspect(fins);
  EXPECT_EQ(report.nonmanifold_edges, 1);
  EXPECT_EQ(report.boundary_edges, 6);
  EXPECT_EQ(report.components, 1);
  EXPECT_FALSE(report.orientable || report.oriented || report.closed || report.manifold);
}

// Without area: a height of less than 1e-12 of the longest edge, at any size.
TEST(MeshReport, ADegenerateFaceIsOneOfNoHeightForItsLength) {
  for (const double length : {0.001, 1.0, 4.0}) {
    const auto degenerate = [&](double height) {
      const TriangleMesh needle{{{0, 0, 0}, {0, length, 0}, {height * length, 0.5 * length, 0}},
                                {{{0, 1, 2}}}};
      return Inspect(needle).degenerate_faces;
    };
    EXPECT_EQ(degenerate(0.9e-12), 1) << length;
    EXPECT_EQ(degenerate(1.1e-12), 0) << length;
  }
}

TEST(MeshReport, SelfIntersectionIsLookedForOnlyWhenAsked) {
  const TriangleMesh crossing =
      shapes::Joined(shapes::Cube(), Transformed(shapes::Cube(), 1.0, {0.5, 0.25, 0.125}));
  EXPECT_TRUE(Inspect(crossing).self_intersecting);
  EXPECT_TRUE(Inspect(crossing, true).self_intersecting);
  EXPECT_FALSE(Inspect(crossing, false).self_intersecting);
}

TEST(MeshReport, TwoFacesOnTheSameCornersIntersect) {
  const TriangleMesh pillow{{{0, 0, 0}, {1, 0, 0}, {0, 2, 0}}, {{{0, 1, 2}, {0, 2, 1}}}};
  const MeshReport report = Inspect(pillow);
  EXPECT_TRUE(report.closed && report.oriented && report.self_intersecting);
  EXPECT_FALSE(report.outward);
  EXPECT_DOUBLE_EQ(report.area, 2.0);
}

// A corner shared, and the far side of one face through the other: seen from either.
TEST(MeshReport, FacesThatShareACornerMayCrossElsewhere) {
  TriangleMesh fan{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.5, 0.2, 1}, {0.5, 0.2, -1}},
                   {{{0, 1, 2}, {0, 3, 4}}}};
  EXPECT_TRUE(Inspect(fan).self_intersecting);
  std::swap(fan.faces[0], fan.faces[1]);
  EXPECT_TRUE(Inspect(fan).self_intersecting);
  // The piercing face begins before the pierced one along x, and after it.
  TriangleMesh late = fan;
  late.vertices = {{0, 0, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 0, -1}, {2, 0, 1}};
  EXPECT_TRUE(Inspect(late).self_intersecting);
  for (auto& v : late.vertices) v = Eigen::Vector3d(-v.x(), -v.y(), v.z());
  EXPECT_TRUE(Inspect(late).self_intersecting);
  for (auto& v : fan.vertices) v = Eigen::Vector3d(-v.x(), -v.y(), v.z());
  EXPECT_TRUE(Inspect(fan).self_intersecting);
  fan.vertices[4].z() = 0.5;
  EXPECT_FALSE(Inspect(fan).self_intersecting);
}

// They are counted instead; a line through a face is no surface.
TEST(MeshReport, FacesWithoutAreaCrossNothing) {
  const TriangleMesh pierced{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, -1}, {1, 1, 1}, {1, 1, 3}},
                             {{{0, 1, 2}, {3, 4, 5}, {3, 4, 4}}}};
  const MeshReport report = Inspect(pierced);
  EXPECT_EQ(report.degenerate_faces, 2);
  EXPECT_FALSE(report.self_intersecting);
}

MeshReport Solid() {
  MeshReport report;
  report.finite = report.closed = report.manifold = true;
  report.orientable = report.oriented = report.outward = true;
  report.components = 1;
  report.volume = 2.0;
  return report;
}

TEST(MeshReport, ASolidNeedsEveryOneOfItsConditions) {
  EXPECT_TRUE(Solid().IsSolid());
  EXPECT_EQ(WhyNotSolid(Solid()), "");
  const std::vector<std::function<void(MeshReport*)>> faults{[](MeshReport* r) { r->finite = false; },
                                                             [](MeshReport* r) { r->manifold = false; },
                                                             [](MeshReport* r) { r->outward = false; },
                                                             [](MeshReport* r) { r->self_intersecting = true; },
                                                             [](MeshReport* r) { r->degenerate_faces = 1; },
                                                             [](MeshReport* r) { r->components = 2; },
                                                             [](MeshReport* r) { r->components = 0; },
                                                             [](MeshReport* r) { r->volume = 0.0; }};
  for (std::size_t i = 0; i < faults.size(); ++i) {
    MeshReport report = Solid();
    faults[i](&report);
    EXPECT_FALSE(report.IsSolid()) << i;
    EXPECT_NE(WhyNotSolid(report), "") << i;
  }
  MeshReport open = Solid();
  open.closed = false;
  EXPECT_FALSE(open.IsSolid());
  MeshReport handle = Solid();
  handle.genus = 2;  // a mug is as solid as a ball
  EXPECT_TRUE(handle.IsSolid());
}

// Everything is wrong at first; each step mends what was named, and the next is named.
TEST(MeshReport, TheFirstFaultInTheOrderOfTheTestsIsNamed) {
  MeshReport report;
  report.self_intersecting = true;
  report.degenerate_faces = 2;
  report.boundary_edges = 2;
  report.nonmanifold_edges = 2;
  EXPECT_EQ(WhyNotSolid(report),
            "not finite: a coordinate is not a number or an index is out of range");
  report.finite = true;
  EXPECT_EQ(WhyNotSolid(report), "empty: no faces");
  report.components = 3;
  EXPECT_EQ(WhyNotSolid(report), "open: 2 boundary edges");
  report.boundary_edges = 1;
  EXPECT_EQ(WhyNotSolid(report), "open: 1 boundary edge");
  report.boundary_edges = 0;
  EXPECT_EQ(WhyNotSolid(report), "non-manifold: 2 edges with more than two faces");
  report.nonmanifold_edges = 0;
  EXPECT_EQ(WhyNotSolid(report), "non-manifold: parts touch in a single vertex");
  report.manifold = true;
  EXPECT_EQ(WhyNotSolid(report), "disjoint pieces: 3");
  report.components = 1;
  EXPECT_EQ(WhyNotSolid(report), "not orientable: one-sided surface");
  report.orientable = true;
  EXPECT_EQ(WhyNotSolid(report), "winding not consistent: neighbouring faces disagree");
  report.oriented = true;
  EXPECT_EQ(WhyNotSolid(report), "degenerate: 2 faces without area");
  report.degenerate_faces = 1;
  EXPECT_EQ(WhyNotSolid(report), "degenerate: 1 face without area");
  report.degenerate_faces = 0;
  EXPECT_EQ(WhyNotSolid(report), "inside-out: volume not positive");
  report.outward = true;  // the volume is still 0
  EXPECT_EQ(WhyNotSolid(report), "inside-out: volume not positive");
  report.volume = 1.0;
  EXPECT_EQ(WhyNotSolid(report), "self-intersecting");
}

}  // namespace
}  // namespace antigrasp
