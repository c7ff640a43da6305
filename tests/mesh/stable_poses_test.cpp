#include "antigrasp/mesh/stable_poses.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "antigrasp/core/rng.h"
#include "antigrasp/mesh/convex_hull.h"
#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using std::numbers::pi;

std::vector<StablePose> Poses(const TriangleMesh& mesh) {
  return StablePoses(mesh, CenterOfMass(mesh));
}

double Sum(const std::vector<StablePose>& poses) {
  double sum = 0.0;
  for (const StablePose& pose : poses) sum += pose.probability;
  return sum;
}

// All points that come from (x, y, z) by even permutations and any signs.
std::vector<Vector3d> EvenPermutations(const Vector3d& v) {
  std::vector<Vector3d> points;
  for (int turn = 0; turn < 3; ++turn) {
    for (int signs = 0; signs < 8; ++signs) {
      const Vector3d p(v[turn], v[(turn + 1) % 3], v[(turn + 2) % 3]);
      points.push_back(
          p.cwiseProduct(Vector3d(signs & 1 ? -1 : 1, signs & 2 ? -1 : 1, signs & 4 ? -1 : 1)));
    }
  }
  return points;
}

const double kGolden = 0.5 * (1.0 + std::sqrt(5.0));

TriangleMesh Tetrahedron() {
  return ConvexHull({{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}});
}
TriangleMesh Octahedron() { return ConvexHull(EvenPermutations({1, 0, 0})); }
TriangleMesh Cuboctahedron() { return ConvexHull(EvenPermutations({1, 1, 0})); }
TriangleMesh Icosahedron() { return ConvexHull(EvenPermutations({0, 1, kGolden})); }
TriangleMesh Dodecahedron() {
  std::vector<Vector3d> points = EvenPermutations({0, 1 / kGolden, kGolden});
  for (const Vector3d& p : EvenPermutations({1, 1, 1})) points.push_back(p);
  return ConvexHull(points);
}

// Of an a x b rectangle seen from the distance d above its middle.
double RectangleSolidAngle(double a, double b, double d) {
  return 4.0 * std::atan(a * b / (2.0 * d * std::sqrt(4.0 * d * d + a * a + b * b)));
}

// Of the parallelogram corner + s u + t v, s and t from 0 to 1, by adding up small pieces.
double ParallelogramSolidAngle(const Vector3d& eye, const Vector3d& corner, const Vector3d& u,
                               const Vector3d& v) {
  constexpr int kPieces = 500;
  const Vector3d piece = u.cross(v) / (kPieces * kPieces);
  double sum = 0.0;
  for (int i = 0; i < kPieces; ++i) {
    for (int j = 0; j < kPieces; ++j) {
      const Vector3d r = corner + (i + 0.5) / kPieces * u + (j + 0.5) / kPieces * v - eye;
      sum += std::abs(piece.dot(r)) / std::pow(r.norm(), 3.0);
    }
  }
  return sum;
}

// A box of base 1 x 1 and height h whose top is moved by `lean` along x.
TriangleMesh LeaningBox(double lean, double h) {
  TriangleMesh mesh = shapes::Cube();
  for (Vector3d& v : mesh.vertices) v = {v.x() + lean * v.z(), v.y(), h * v.z()};
  return mesh;
}

Matrix3d SomeRotation() {
  return Eigen::AngleAxisd(0.7, Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
}

TEST(StablePoses, RegularSolidsRestOnEveryFaceAlike) {
  const std::vector<std::pair<TriangleMesh, std::size_t>> solids{{Tetrahedron(), 4},
                                                                 {shapes::Cube(), 6},
                                                                 {Octahedron(), 8},
                                                                 {Dodecahedron(), 12},
                                                                 {Icosahedron(), 20}};
  for (const auto& [mesh, faces] : solids) {
    for (const TriangleMesh& turned : {mesh, shapes::Rotated(mesh, SomeRotation())}) {
      const auto poses = Poses(turned);
      ASSERT_EQ(poses.size(), faces);
      for (const StablePose& pose : poses) {
        EXPECT_NEAR(pose.probability, 1.0 / static_cast<double>(faces), 1e-12);
        EXPECT_NEAR(pose.com_height, poses.front().com_height, 1e-12);
      }
    }
  }
}

TEST(StablePoses, OfACuboctahedronAreSixSquaresAndEightTriangles) {
  // A triangle's corners are unit vectors 60 degrees apart: its angles on the sphere are acos(1/3).
  const double triangle = 3.0 * std::acos(1.0 / 3.0) - pi;
  const double square = (4.0 * pi - 8.0 * triangle) / 6.0;
  const auto poses = Poses(Cuboctahedron());
  ASSERT_EQ(poses.size(), 14u);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    EXPECT_NEAR(poses[i].probability, (i < 6 ? square : triangle) / (4.0 * pi), 1e-12) << i;
    EXPECT_NEAR(poses[i].com_height, i < 6 ? 1.0 : 2.0 / std::sqrt(3.0), 1e-12) << i;
  }
  EXPECT_NEAR(Sum(poses), 1.0, 1e-12);
}

TEST(StablePoses, OfALongBoxHaveTheSolidAnglesOfItsFaces) {
  const auto poses = Poses(shapes::Box({1, 2, 5}));
  ASSERT_EQ(poses.size(), 6u);
  const double expected[] = {RectangleSolidAngle(2, 5, 0.5), RectangleSolidAngle(1, 5, 1.0),
                             RectangleSolidAngle(1, 2, 2.5)};
  const double heights[] = {0.5, 1.0, 2.5};
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_NEAR(poses[i].probability, expected[i / 2] / (4.0 * pi), 1e-12) << i;
    EXPECT_NEAR(poses[i].com_height, heights[i / 2], 1e-12) << i;
  }
}

TEST(StablePoses, ALeaningBoxRollsFromItsEndsOntoTheSidesThatLeanOver) {
  constexpr double kLean = 2.5, kHeight = 2.0;
  const auto poses = Poses(LeaningBox(kLean, kHeight));
  ASSERT_EQ(poses.size(), 4u);  // of six faces two do not carry it
  const Vector3d eye = Vector3d::Zero(), up(kLean, 0, kHeight), corner = -0.5 * up;
  const double end = ParallelogramSolidAngle(eye, corner - Vector3d(0.5, 0.5, 0), Vector3d::UnitX(),
                                             Vector3d::UnitY());
  const double leaning =
      ParallelogramSolidAngle(eye, corner + Vector3d(0.5, -0.5, 0), up, Vector3d::UnitY());
  const double side =
      ParallelogramSolidAngle(eye, corner + Vector3d(-0.5, -0.5, 0), up, Vector3d::UnitX());
  ASSERT_NEAR(2 * (end + leaning + side), 4 * pi, 1e-4);
  EXPECT_NEAR(Sum(poses), 1.0, 1e-12);
  int over = 0;
  for (const StablePose& pose : poses) {
    const bool lies_on_side = std::abs(pose.table_from_object(2, 1)) > 0.999;
    over += lies_on_side ? 0 : 1;
    EXPECT_NEAR(pose.probability, (lies_on_side ? side : end + leaning) / (4.0 * pi), 1e-5);
  }
  EXPECT_EQ(over, 2);
}

TEST(StablePoses, StandsAsLongAsTheCentreOfMassIsAboveTheBase) {
  EXPECT_EQ(Poses(LeaningBox(0.99, 4.0)).size(), 6u);
  EXPECT_EQ(Poses(LeaningBox(1.00, 4.0)).size(), 4u);  // balanced above the edge: falls
  EXPECT_EQ(Poses(LeaningBox(1.01, 4.0)).size(), 4u);
}

TEST(StablePoses, PutTheObjectOnTheTable) {
  const TriangleMesh mesh = shapes::Rotated(LeaningBox(1.5, 1.2), SomeRotation());
  for (const StablePose& pose : Poses(mesh)) {
    const Matrix3d& r = pose.table_from_object;
    EXPECT_NEAR((r * r.transpose() - Matrix3d::Identity()).norm(), 0.0, 1e-12);
    EXPECT_NEAR(r.determinant(), 1.0, 1e-12);
    const Vector3d com = r * CenterOfMass(mesh);
    int on_table = 0;
    for (const Vector3d& v : mesh.vertices) {
      const double height = (r * v).z() - (com.z() - pose.com_height);
      EXPECT_GT(height, -1e-12);
      on_table += height < 1e-12 ? 1 : 0;
    }
    EXPECT_EQ(on_table, 4);
  }
}

TEST(StablePoses, MoveWithTheObject) {
  const TriangleMesh mesh = ConvexHull({{0, 0, 0}, {3, 0, 0}, {0, 2, 0}, {1, 1, 4}, {2, 2, 1}});
  const auto poses = Poses(mesh);
  const Matrix3d turn = SomeRotation();
  const auto moved = Poses(Transformed(shapes::Rotated(mesh, turn), 0.01, Vector3d(1, -2, 3)));
  ASSERT_EQ(poses.size(), moved.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    EXPECT_NEAR(moved[i].probability, poses[i].probability, 1e-9);
    EXPECT_NEAR(moved[i].com_height, 0.01 * poses[i].com_height, 1e-9);
    const Vector3d up = poses[i].table_from_object.row(2),
                   up_moved = moved[i].table_from_object.row(2);
    EXPECT_NEAR((turn * up - up_moved).norm(), 0.0, 1e-9);
  }
}

TEST(StablePoses, StandTheRightWayUpWithTheFirstRowLevelInTheObjectsFrame) {
  // Corners (0,0,0), e_x, e_y, e_z: the slanted face has the normal (1,1,1) / sqrt 3 and is 1 / (4
  // sqrt 3) from the mean of the corners, the others are 1/4 away. On that face up is -(1,1,1).
  const auto poses = Poses(shapes::Tetrahedron());
  ASSERT_EQ(poses.size(), 4u);
  const Matrix3d& slanted = poses[0].table_from_object;
  EXPECT_NEAR(poses[0].com_height, 0.25 / std::sqrt(3.0), 1e-12);
  const double third = 1.0 / std::sqrt(3.0), half = 1.0 / std::sqrt(2.0), sixth = third * half;
  Matrix3d expected;
  expected << half, -half, 0.0, -sixth, -sixth, 2.0 * sixth, -third, -third, -third;
  EXPECT_NEAR((slanted - expected).norm(), 0.0, 1e-12) << slanted;
  // The three alike in the order of their up directions; upright, row 0 is x.
  for (int k = 0; k < 3; ++k) {
    const StablePose& pose = poses[static_cast<std::size_t>(k) + 1];
    EXPECT_NEAR(pose.com_height, 0.25, 1e-12);
    EXPECT_NEAR(pose.table_from_object(2, 2 - k), 1.0, 1e-12) << k;
    EXPECT_EQ(pose.table_from_object(0, 2), 0.0);
  }
  EXPECT_LT((poses[1].table_from_object - Matrix3d::Identity()).norm(), 1e-12);
}

TEST(StablePoses, KeepFortyFourBitsSoThatEqualMeshesHaveEqualPoses) {
  for (const StablePose& pose : Poses(shapes::Rotated(shapes::Box({1, 2, 5}), SomeRotation()))) {
    for (const double number : {pose.probability, pose.com_height}) {
      int exponent = 0;
      const double kept = std::frexp(number, &exponent) * 0x1p44;
      EXPECT_EQ(kept, std::round(kept)) << number;
    }
  }
}

TEST(StablePoses, DoNotCountFlatFacetsTwiceWhenTheirCornersAreRounded) {
  TriangleMesh mesh = shapes::Rotated(shapes::Box({0.04, 0.05, 0.06}), SomeRotation());
  // More corners on edges and faces, all rounded to float as a binary STL has them.
  const auto corners = mesh.vertices;
  for (const Vector3d& a : corners) {
    for (const Vector3d& b : corners) mesh.vertices.push_back(0.25 * a + 0.75 * b);
  }
  for (Vector3d& v : mesh.vertices) v = v.cast<float>().cast<double>();
  const auto poses = Poses(mesh);
  ASSERT_EQ(poses.size(), 6u);
  EXPECT_NEAR(poses[0].probability, RectangleSolidAngle(0.05, 0.06, 0.02) / (4.0 * pi), 1e-5);
  EXPECT_NEAR(Sum(poses), 1.0, 1e-12);
}

TEST(StablePoses, ABallOfManyFacetsRestsOnEachOfThem) {
  const auto poses = Poses(shapes::Sphere(1.0, 3));
  EXPECT_EQ(poses.size(), 1280u);
  EXPECT_NEAR(Sum(poses), 1.0, 1e-12);
}

// Where the downward direction ends that goes down the height of the centre of mass in small steps,
// from landing on the facet with this normal: knows nothing of edges, corners or facets.
Vector3d SteepestDescent(const TriangleMesh& hull, const Vector3d& com, Vector3d down) {
  double step = 2e-4;
  for (int i = 0; i < 60000; ++i) {
    if (i > 30000) step *= 0.9997;
    const auto lowest = std::max_element(
        hull.vertices.begin(), hull.vertices.end(),
        [&](const Vector3d& a, const Vector3d& b) { return a.dot(down) < b.dot(down); });
    const Vector3d arm = *lowest - com;
    down = (down - step * (arm - arm.dot(down) * down)).normalized();
  }
  return down;
}

TEST(StablePoses, RollTheWayTheCentreOfMassSinksFastest) {
  int unstable = 0;
  for (std::uint64_t object = 0; object < 12; ++object) {
    RngStream rng(3, "roll", object);
    std::vector<Vector3d> points;
    for (int i = 0; i < 6; ++i) points.emplace_back(rng.Normal(), rng.Normal(), 1.5 * rng.Normal());
    const TriangleMesh hull = ConvexHull(points);
    const Vector3d com = CenterOfMass(hull);
    const auto poses = StablePoses(hull, com);
    std::vector<double> expected(poses.size(), 0.0);
    for (std::size_t f = 0; f < hull.faces.size(); ++f) {
      const Vector3d normal = FaceCross(hull, f).normalized();
      const Vector3d down = SteepestDescent(hull, com, normal);
      std::size_t best = 0;
      const auto facing = [&](std::size_t i) {
        return -poses[i].table_from_object.row(2).dot(down);
      };
      for (std::size_t i = 0; i < poses.size(); ++i) best = facing(i) > facing(best) ? i : best;
      EXPECT_GT(facing(best), 0.9999) << "object " << object << " facet " << f;
      unstable += normal.dot(down) < 0.9999 ? 1 : 0;
      // The facet's share, from three of its corners as a hull of their own seen from outside.
      std::array<Vector3d, 3> t;
      for (std::size_t k = 0; k < 3; ++k) {
        t[k] = (hull.vertices[static_cast<std::size_t>(hull.faces[f][k])] - com).normalized();
      }
      const double half = std::atan2(std::abs(t[0].dot(t[1].cross(t[2]))),
                                     1.0 + t[0].dot(t[1]) + t[1].dot(t[2]) + t[2].dot(t[0]));
      expected[best] += 2.0 * half / (4.0 * pi);
    }
    for (std::size_t i = 0; i < poses.size(); ++i) {
      EXPECT_NEAR(poses[i].probability, expected[i], 1e-9) << "object " << object << " pose " << i;
    }
  }
  EXPECT_GT(unstable, 20);
}

TEST(StablePoses, ThereAreNoneForAFlatObjectOrACentreOfMassOutside) {
  EXPECT_TRUE(StablePoses(shapes::FlatSquare(), Vector3d::Zero()).empty());
  EXPECT_TRUE(StablePoses({}, Vector3d::Zero()).empty());
  EXPECT_TRUE(StablePoses(shapes::Cube(), Vector3d(2, 0, 0)).empty());
  EXPECT_TRUE(StablePoses(shapes::Cube(), Vector3d(0.5, 0, 0)).empty());
}

TEST(StablePoses, AnUprightPoseKeepsTheObjectsAxesThoughRoundingTiltsIt) {
  // The tilt's direction, here along y and x, must not turn the object about the vertical.
  for (const Vector3d& tilt : {Vector3d(2e-6, 0.0, 1.0), Vector3d(0.0, -2e-6, 1.0)}) {
    const Matrix3d turn =
        Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), tilt.normalized()).toRotationMatrix();
    int upright = 0;
    for (const StablePose& pose : Poses(shapes::Rotated(shapes::Box({3.0, 2.0, 1.0}), turn))) {
      if (std::abs(pose.table_from_object(2, 2)) < 0.5) continue;
      ++upright;
      EXPECT_NEAR(pose.table_from_object(0, 0), 1.0, 1e-5);
      EXPECT_NEAR(
          (pose.table_from_object * pose.table_from_object.transpose() - Matrix3d::Identity())
              .norm(),
          0.0, 1e-12);
    }
    EXPECT_EQ(upright, 2);
  }
}

}  // namespace
}  // namespace antigrasp
