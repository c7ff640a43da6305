#include "antigrasp/sdf/mesh_to_sdf.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "antigrasp/core/rng.h"
#include "antigrasp/sdf/marching_cubes.h"
#include "tests/sdf/fields.h"
#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

SdfGrid Distances(const TriangleMesh& mesh, int n = 32) {
  SdfGrid grid = UnitCubeGrid(n);
  MeshToSdf(mesh, &grid);
  return grid;
}

double LargestDifference(const SdfGrid& a, const SdfGrid& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.values.size(); ++i) {
    largest = std::max(largest, std::abs(1.0 * a.values[i] - b.values[i]));
  }
  return largest;
}

// Nearest point of a triangle by its Voronoi regions (Ericson, "Real-time collision detection",
// 5.1.5): another method than the one under test.
double PlainTriangleDistance(const Vector3d& p, const Vector3d& a, const Vector3d& b,
                             const Vector3d& c) {
  const Vector3d ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap), d3 = ab.dot(bp), d4 = ac.dot(bp);
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d1 <= 0 && d2 <= 0) return ap.norm();
  if (d3 >= 0 && d4 <= d3) return bp.norm();
  if (d6 >= 0 && d5 <= d6) return cp.norm();
  const double va = d3 * d6 - d5 * d4, vb = d5 * d2 - d1 * d6, vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return (ap - d1 / (d1 - d3) * ab).norm();
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return (ap - d2 / (d2 - d6) * ac).norm();
  if (va <= 0 && d4 >= d3 && d5 >= d6) {
    return (bp - (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b)).norm();
  }
  return (ap - (vb * ab + vc * ac) / (va + vb + vc)).norm();
}

double BruteForceDistance(const TriangleMesh& mesh, const Vector3d& p) {
  double best = std::numeric_limits<double>::infinity();
  for (const auto& f : mesh.faces) {
    best = std::min(best, PlainTriangleDistance(p, mesh.vertices[f[0]], mesh.vertices[f[1]],
                                                mesh.vertices[f[2]]));
  }
  return best;
}

Eigen::Matrix3d SomeRotation(std::uint64_t seed) {
  RngStream rng(seed, "rotation");
  return Eigen::Quaterniond(rng.Normal(), rng.Normal(), rng.Normal(), rng.Normal())
      .normalized()
      .toRotationMatrix();
}

TEST(MeshToSdf, FineSphereMatchesTheFormula) {
  const SdfGrid exact = Sampled(32, [](const Vector3d& p) { return SphereDistance(p, 0.4); });
  EXPECT_LT(LargestDifference(Distances(shapes::Sphere(0.4, 4)), exact), 0.4 * 0.002);
}

TEST(MeshToSdf, BoxMatchesTheFormulaToFloatPrecision) {
  const Vector3d extents(0.61, 0.37, 0.83);
  const SdfGrid exact = Sampled(32, [&](const Vector3d& p) { return BoxDistance(p, extents); });
  EXPECT_LT(LargestDifference(Distances(shapes::Box(extents)), exact), 1e-7);
}

TEST(MeshToSdf, TorusMatchesTheFormula) {
  const SdfGrid exact = Sampled(32, [](const Vector3d& p) { return TorusDistance(p, 0.3, 0.12); });
  EXPECT_LT(LargestDifference(Distances(shapes::Torus(0.3, 0.12, 192, 96)), exact), 1e-3);
}

// Faces, edges and corners exactly on nodes, and rows of nodes that run inside faces and along
// edges.
TEST(MeshToSdf, BoxWithFacesOnNodesKeepsItsSigns) {
  for (const int half_nodes : {1, 5, 15}) {
    const double side = (2 * half_nodes - 1) / 32.0;
    const Vector3d extents = Vector3d::Constant(side);
    const SdfGrid exact = Sampled(32, [&](const Vector3d& p) { return BoxDistance(p, extents); });
    EXPECT_LT(LargestDifference(Distances(shapes::Box(extents)), exact), 1e-7);
  }
}

TEST(MeshToSdf, VerticesAndEdgesOnRowsNeverFlipASign) {
  // Grid symmetric about the node rows y = 0 and z = 0, so that rows meet vertices and edges.
  SdfGrid grid;
  grid.n = 17;
  grid.spacing = 1.0 / 16;
  grid.origin = Vector3d::Constant(-0.5);
  const TriangleMesh along_z = shapes::Cylinder(0.375, 0.75, 8);
  const Eigen::Matrix3d to_x = Eigen::AngleAxisd(std::acos(0.0), Vector3d::UnitY()).matrix();
  for (const TriangleMesh& mesh : {along_z, shapes::Rotated(along_z, to_x),
                                   shapes::Sphere(0.375, 1), shapes::Torus(0.25, 0.125, 8, 4)}) {
    MeshToSdf(mesh, &grid);
    for (const Vector3d& shift : {Vector3d(0, 1e-7, 2e-7), Vector3d(0, -2e-7, 1e-7)}) {
      SdfGrid moved = grid;  // rows off the vertices by a hair: nothing may change but the hair
      MeshToSdf(Transformed(mesh, 1.0, shift), &moved);
      EXPECT_LT(LargestDifference(grid, moved), 1e-6);
    }
  }
}

TEST(MeshToSdf, AgreesWithTheDistanceToEveryTriangle) {
  const TriangleMesh mesh = shapes::Rotated(shapes::Torus(0.27, 0.11, 24, 12), SomeRotation(3));
  const SdfGrid grid = Distances(mesh, 16);
  for (int z = 0; z < 16; ++z) {
    for (int y = 0; y < 16; ++y) {
      for (int x = 0; x < 16; ++x) {
        EXPECT_NEAR(std::abs(grid.values[grid.Index(x, y, z)]),
                    BruteForceDistance(mesh, grid.Node(x, y, z)), 1e-7);
      }
    }
  }
}

TEST(MeshToSdf, RigidMotionOfMeshAndPointsKeepsDistances) {
  const TriangleMesh mesh = shapes::Box({0.5, 0.3, 0.2});
  const MeshDistance still(mesh);
  const Eigen::Matrix3d rotation = SomeRotation(8);
  const Vector3d shift(0.1, -0.2, 0.05);
  const MeshDistance moved(Transformed(shapes::Rotated(mesh, rotation), 1.0, shift));
  RngStream rng(4, "points");
  for (int i = 0; i < 500; ++i) {
    const Vector3d p(rng.Uniform(-1, 1), rng.Uniform(-1, 1), rng.Uniform(-1, 1));
    EXPECT_NEAR(still.Unsigned(p), moved.Unsigned(rotation * p + shift), 1e-14);
  }
}

TEST(MeshToSdf, SignsOfARotatedBoxMatchTheFormula) {
  const Vector3d extents(0.55, 0.4, 0.3);
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const Eigen::Matrix3d rotation = SomeRotation(seed);
    const SdfGrid exact = Sampled(
        24, [&](const Vector3d& p) { return BoxDistance(rotation.transpose() * p, extents); });
    const SdfGrid grid = Distances(shapes::Rotated(shapes::Box(extents), rotation), 24);
    EXPECT_LT(LargestDifference(grid, exact), 1e-6);
  }
}

TEST(MeshToSdf, RoundTripThroughMarchingCubesKeepsTheSurface) {
  const SdfGrid ball = Sampled(32, [](const Vector3d& p) { return SphereDistance(p, 0.35); });
  const SdfGrid again = Distances(MarchingCubes(ball));
  EXPECT_LT(LargestDifference(ball, again), 0.1 * ball.spacing);
}

TEST(MeshToSdf, DegenerateFacesCountAsTheirEdges) {
  TriangleMesh mesh = shapes::Cube();
  mesh = Transformed(mesh, 0.5, Vector3d::Zero());
  // Split the edge of one face at its middle with a zero-area face: still closed.
  TriangleMesh split = mesh;
  const auto face = split.faces[0];
  const auto middle = static_cast<std::int32_t>(split.vertices.size());
  split.vertices.push_back(0.5 * (mesh.vertices[face[0]] + mesh.vertices[face[1]]));
  split.faces[0] = {face[0], middle, face[2]};
  split.faces.push_back({middle, face[1], face[2]});
  split.faces.push_back({face[0], face[1], middle});
  EXPECT_LT(LargestDifference(Distances(mesh), Distances(split)), 1e-7);
}

TEST(MeshToSdf, MeshOutsideTheGridLeavesNegativeDistances) {
  const SdfGrid grid = Distances(Transformed(shapes::Cube(), 0.5, Vector3d(3, 3, 3)), 8);
  for (const float v : grid.values) EXPECT_LT(v, -2.0F);
}

TEST(MeshToSdf, RefusesOpenEmptyAndBrokenMeshes) {
  SdfGrid grid = UnitCubeGrid(8);
  TriangleMesh open = Transformed(shapes::Cube(), 0.5, Vector3d::Zero());
  const auto faces_x = [&](const std::array<std::int32_t, 3>& f) {
    return std::abs(open.vertices[f[0]].x() - open.vertices[f[1]].x()) +
               std::abs(open.vertices[f[0]].x() - open.vertices[f[2]].x()) <
           1e-9;
  };
  open.faces.erase(std::find_if(open.faces.begin(), open.faces.end(), faces_x));
  EXPECT_THROW(MeshToSdf(open, &grid), std::logic_error);
  EXPECT_THROW(MeshToSdf(TriangleMesh{}, &grid), std::logic_error);
  TriangleMesh broken = shapes::Cube();
  broken.faces[0][1] = 99;
  EXPECT_THROW(MeshToSdf(broken, &grid), std::logic_error);
}

}  // namespace
}  // namespace antigrasp
