// The test of whole meshes beside the exact one of a cell's triangles, which knows integers alone.
#include "antigrasp/mesh/self_intersection.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "antigrasp/core/rng.h"
#include "antigrasp/mesh/face_intersection.h"
#include "antigrasp/mesh/inspect.h"
#include "antigrasp/mesh/vertex_stars.h"
#include "antigrasp/sdf/cell_crossing.h"
#include "antigrasp/sdf/marching_cubes.h"
#include "tests/sdf/fields.h"
#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

IntTriangle Integers(const TriangleMesh& mesh, std::size_t face) {
  IntTriangle out;
  for (std::size_t c = 0; c < 3; ++c) {
    const Vector3d& v = mesh.vertices[static_cast<std::size_t>(mesh.faces[face][c])];
    for (int k = 0; k < 3; ++k) {
      out[c][static_cast<std::size_t>(k)] = static_cast<std::int64_t>(v[k]);
    }
  }
  return out;
}

bool AnyCrosses(const TriangleMesh& mesh) {
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    for (std::size_t g = 0; g < f; ++g) {
      const IntTriangle a = Integers(mesh, f), b = Integers(mesh, g);
      if (!IsDegenerate(a) && !IsDegenerate(b) && Crosses(a, b)) return true;
    }
  }
  return false;
}

// A few faces on some of the 5 x 5 x `layers` places, so that planes, lines and points are shared.
TriangleMesh FewFaces(std::uint64_t trial, int layers, RngStream* rng) {
  TriangleMesh mesh;
  for (int z = 0; z < layers; ++z) {
    for (int y = 0; y < 5; ++y) {
      for (int x = 0; x < 5; ++x) {
        if (rng->Below(4) == 0) mesh.vertices.push_back(Vector3d(x, y, z));
      }
    }
  }
  while (mesh.vertices.size() < 4) {
    const double n = static_cast<double>(mesh.vertices.size());
    mesh.vertices.push_back(Vector3d(n, -1.0, 0.0));
  }
  const auto pick = [&] { return static_cast<std::int32_t>(rng->Below(mesh.vertices.size())); };
  for (std::uint64_t i = 0; i < 2 + trial % 4; ++i) mesh.faces.push_back({pick(), pick(), pick()});
  return mesh;
}

// A map of full rank with large integers: what meets still does, and lies in one plane where it
// did, but no product of coordinates is exact in double.
Matrix3d LargeMap(RngStream* rng) {
  Matrix3d map;
  do {
    for (int i = 0; i < 9; ++i) {
      map.data()[i] = static_cast<double>(rng->Below(1u << 31)) * 4099.0 - 4.4e12;
    }
  } while (map.fullPivLu().rank() < 3 || std::abs(map.determinant()) < 1e30);
  return map;
}

TEST(SelfIntersection, OfFewFacesIsThatOfIntegers) {
  int meeting = 0;
  for (std::uint64_t trial = 0; trial < 3000; ++trial) {
    RngStream rng(3, "faces", trial);
    const TriangleMesh mesh = FewFaces(trial, trial % 3 == 0 ? 1 : 3, &rng);
    const bool expected = AnyCrosses(mesh);
    meeting += expected;
    ASSERT_EQ(SelfIntersects(mesh), expected) << trial;
    ASSERT_EQ(SelfIntersects(shapes::Rotated(mesh, LargeMap(&rng))), expected) << trial;
  }
  EXPECT_GT(meeting, 600);
  EXPECT_LT(meeting, 2400);
}

// Fields of noise make surfaces that fold, touch the border, and cross nowhere: a cell's triangles
// do not. With vertices moved some cross.
TEST(SelfIntersection, OfMarchingCubesIsThatOfEveryPairOfFaces) {
  int meeting = 0;
  for (std::uint64_t trial = 0; trial < 12; ++trial) {
    RngStream rng(5, "moved", trial);
    const SdfGrid grid = WhiteNoise(6, trial);
    TriangleMesh mesh = shapes::Rotated(MarchingCubes(grid), LargeMap(&rng) / 1e13);
    for (std::uint64_t moved = 0; moved < trial / 3; ++moved) {
      const std::size_t from = rng.Below(mesh.vertices.size()),
                        to = rng.Below(mesh.vertices.size());
      mesh.vertices[from] += 0.5 * (mesh.vertices[to] - mesh.vertices[from]);
    }
    bool expected = false;
    for (std::int32_t f = 0; f < std::ssize(mesh.faces); ++f) {
      for (std::int32_t g = 0; g < f; ++g) expected = expected || FacesIntersect(mesh, f, g);
    }
    meeting += expected;
    EXPECT_EQ(SelfIntersects(mesh), expected) << trial;
  }
  EXPECT_GT(meeting, 2);
  EXPECT_LT(meeting, 11);
}

TEST(PlainStars, AreThoseOfEverySolidsCornersAndOfFlatPlaces) {
  for (const TriangleMesh& mesh :
       {shapes::Cube(), shapes::Box({1, 5, 1e-3}), shapes::Sphere(1.0, 3),
        shapes::Torus(1.0, 0.3, 24, 12), shapes::Inverted(shapes::Cube())}) {
    for (const char plain : PlainStars(mesh)) EXPECT_EQ(plain, 1);
  }
  // The rim of a square is open: nothing is said of it.
  for (const char plain : PlainStars(shapes::FlatSquare())) EXPECT_EQ(plain, 0);
}

// `turns` times round the origin in `faces` steps, each lower than the last by a little.
TriangleMesh Fan(int faces, int turns) {
  TriangleMesh mesh;
  mesh.vertices.push_back(Vector3d::Zero());
  for (int i = 0; i < faces; ++i) {
    const double angle = 0.3 + 2.0 * M_PI * turns * i / faces;
    mesh.vertices.push_back(Vector3d(std::cos(angle), std::sin(angle), -0.3 - 0.01 * i));
    mesh.faces.push_back({0, i + 1, (i + 1) % faces + 1});
  }
  return mesh;
}

TEST(PlainStars, GoRoundOnce) {
  for (const int faces : {3, 4, 5, 6, 7, 16, 100}) {
    EXPECT_EQ(PlainStars(Fan(faces, 1))[0], 1) << faces;
    EXPECT_FALSE(SelfIntersects(Fan(faces, 1)));
  }
  for (const int faces : {5, 7, 9, 11}) EXPECT_EQ(PlainStars(Fan(faces, 2))[0], 0) << faces;
  EXPECT_TRUE(SelfIntersects(Fan(5, 2)));
  // A fan that is not closed, one folded over, and two fans on one vertex.
  TriangleMesh open = Fan(6, 1);
  open.faces.pop_back();
  EXPECT_EQ(PlainStars(open)[0], 0);
  TriangleMesh folded = Fan(6, 1);
  std::swap(folded.vertices[2], folded.vertices[3]);
  EXPECT_EQ(PlainStars(folded)[0], 0);
  TriangleMesh twice = Fan(5, 1);
  const TriangleMesh other = Transformed(Fan(5, 1), 0.5, Vector3d::Zero());
  for (const auto& face : other.faces) twice.faces.push_back({0, face[1] + 5, face[2] + 5});
  twice.vertices.insert(twice.vertices.end(), other.vertices.begin() + 1, other.vertices.end());
  EXPECT_EQ(PlainStars(twice)[0], 0);
}

TEST(SelfIntersection, HoldsForCoordinatesOfAnySize) {
  TriangleMesh crossing =
      shapes::Joined(shapes::Cube(), Transformed(shapes::Cube(), 1.0, {0.5, 0.25, 0.75}));
  for (const double scale :
       {1e-300, 1e-160, 1e-105, 1e-100, 1e-30, 1.0, 1e30, 1e100, 1e150, 1e300}) {
    EXPECT_TRUE(SelfIntersects(Transformed(crossing, scale, Vector3d::Zero()))) << scale;
    EXPECT_FALSE(
        SelfIntersects(Transformed(shapes::Torus(1.0, 0.3, 16, 8), scale, Vector3d::Zero())))
        << scale;
  }
  // A face whose last corner is a millionth below the other's plane.
  TriangleMesh nearly;
  nearly.vertices = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, 1e-6}, {2, 1, 1e-6}, {1, 2, -1e-6}};
  nearly.faces = {{0, 1, 2}, {3, 4, 5}};
  for (const double scale : {1e-103, 1e-104, 1e-105, 1e-106, 1e-107, 1.0}) {
    EXPECT_TRUE(SelfIntersects(Transformed(nearly, scale, Vector3d::Zero()))) << scale;
  }
}

}  // namespace
}  // namespace antigrasp
