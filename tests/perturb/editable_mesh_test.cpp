#include "antigrasp/perturb/editable_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "antigrasp/mesh/inspect.h"
#include "antigrasp/mesh/self_intersection.h"
#include "tests/perturb/perturbed_shapes.h"
#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;
constexpr double kPi = std::numbers::pi;

// Nothing but intersections is tested.
MoveLimits OnlyIntersections() {
  MoveLimits limits;
  limits.max_turn_per_move = kPi;
  limits.min_height = 0.0;
  return limits;
}

TEST(EditableMesh, RefusesExactlyTheMovesAfterWhichTheWholeMeshMeetsItself) {
  RngStream rng(1, "local_test");
  int refused = 0, accepted = 0;
  for (const TriangleMesh& shape :
       {shapes::Sphere(1.0, 2), shapes::Torus(1.0, 0.3, 20, 10), shapes::Box({1.0, 1.0, 0.1}),
        shapes::Cylinder(0.5, 0.2, 16), shapes::Dodecahedron()}) {
    EditableMesh mesh(shape, OnlyIntersections());
    ASSERT_FALSE(SelfIntersects(mesh.mesh()));
    for (int i = 0; i < 250; ++i) {
      const auto vertex =
          static_cast<std::int32_t>(rng.Below(static_cast<std::uint64_t>(mesh.num_vertices())));
      const double size = std::pow(10.0, rng.Uniform(-2.0, 0.3));
      const Vector3d to =
          mesh.Position(vertex) + size * Vector3d(rng.Normal(), rng.Normal(), rng.Normal());
      TriangleMesh expected = mesh.mesh();
      expected.vertices[vertex] = InSinglePrecision(to);
      const MoveVerdict verdict = mesh.TryMove(vertex, to);
      if (verdict == MoveVerdict::kDegenerate) continue;
      ASSERT_EQ(verdict == MoveVerdict::kIntersects, SelfIntersects(expected)) << i;
      verdict == MoveVerdict::kOk ? ++accepted : ++refused;
      // Some moves stay, so that the tree is tested far from how it was built.
      verdict == MoveVerdict::kOk&& rng.Below(3) == 0 ? mesh.Commit() : mesh.Undo();
    }
    EXPECT_FALSE(SelfIntersects(mesh.mesh()));
  }
  EXPECT_GT(refused, 180);
  EXPECT_GT(accepted, 180);
}

TEST(EditableMesh, UndoTakesBackAllMovesSinceTheLastCommitBitByBit) {
  RngStream rng(2, "undo");
  EditableMesh mesh(shapes::Sphere(1.0, 2));
  const TriangleMesh start = mesh.mesh();
  ASSERT_EQ(mesh.TryMove(3, 1.05 * mesh.Position(3)), MoveVerdict::kOk);
  mesh.Commit();
  const TriangleMesh committed = mesh.mesh();
  const Vector3d normal = mesh.Normal(mesh.FacesOf(7)[0]);
  for (const std::int32_t v : {7, 8, 7, 3}) {
    ASSERT_EQ(mesh.TryMove(v, 1.03 * mesh.Position(v)), MoveVerdict::kOk);
  }
  EXPECT_NE(mesh.Normal(mesh.FacesOf(7)[0]), normal);
  EXPECT_FALSE(mesh.ChangedFaces().empty());
  mesh.Undo();
  EXPECT_EQ(mesh.mesh().vertices, committed.vertices);
  EXPECT_NE(mesh.mesh().vertices, start.vertices);
  EXPECT_EQ(mesh.Normal(mesh.FacesOf(7)[0]), normal);
  EXPECT_TRUE(mesh.ChangedFaces().empty());
  mesh.Undo();
  EXPECT_EQ(mesh.mesh().vertices, committed.vertices);
}

TEST(EditableMesh, ARefusedMoveChangesNothingAndKeepsEarlierMovesOpen) {
  EditableMesh mesh(shapes::Sphere(1.0, 2));
  ASSERT_EQ(mesh.TryMove(0, 1.05 * mesh.Position(0)), MoveVerdict::kOk);
  const TriangleMesh before = mesh.mesh();
  const auto changed = mesh.ChangedFaces();
  EXPECT_EQ(mesh.TryMove(1, {1e300, 0, 0}), MoveVerdict::kNotFinite);
  EXPECT_EQ(mesh.TryMove(1, {std::nan(""), 0, 0}), MoveVerdict::kNotFinite);
  EXPECT_EQ(mesh.TryMove(1, -mesh.Position(1)), MoveVerdict::kInverted);
  const auto& face = mesh.mesh().faces[mesh.FacesOf(1)[0]];
  const std::int32_t neighbour = face[0] == 1 ? face[1] : face[0];
  EXPECT_EQ(mesh.TryMove(1, mesh.Position(neighbour)), MoveVerdict::kDegenerate);
  EXPECT_EQ(mesh.mesh().vertices, before.vertices);
  EXPECT_EQ(mesh.ChangedFaces(), changed);
}

TEST(EditableMesh, KeepsFacesWithinTheAngleOfTheStart) {
  MoveLimits limits;
  limits.max_turn_from_start = 5 * kPi / 180;
  EditableMesh mesh(shapes::Box({2, 2, 2}), limits);
  // A corner of the box pushed along an edge direction turns a side by atan(step / side).
  const Vector3d corner = mesh.Position(0);
  EXPECT_EQ(mesh.TryMove(0, corner + Vector3d(0, 0, 2 * std::tan(0.04))), MoveVerdict::kOk);
  mesh.Commit();
  EXPECT_EQ(mesh.TryMove(0, corner + Vector3d(0, 0, 2 * std::tan(0.20))), MoveVerdict::kTurned);
  EXPECT_EQ(mesh.TryMove(0, corner), MoveVerdict::kOk);
}

TEST(EditableMesh, TheStartIsTheFirstMeshAndAMoveIsMeasuredByTheLast) {
  // The corner of a slab 2 wide lifted in steps of about 2 degrees each.
  MoveLimits limits;
  limits.max_turn_from_start = 5 * kPi / 180;
  limits.max_turn_per_move = 3 * kPi / 180;
  const auto lifted = [&](EditableMesh* mesh, double degrees) {
    // The nearest far edge of the corner's faces at the top is the diagonal, sqrt 2 away, or a leg.
    const Vector3d corner = shapes::Box({2, 2, 2}).vertices[7];
    return mesh->TryMove(7, corner + Vector3d(0, 0, 2 * std::tan(degrees * kPi / 180)));
  };
  EditableMesh mesh(shapes::Box({2, 2, 2}), limits);
  EXPECT_EQ(lifted(&mesh, 3.1 * std::sqrt(2.0)), MoveVerdict::kInverted);
  for (const double degrees : {1.5, 3.0}) {
    ASSERT_EQ(lifted(&mesh, degrees), MoveVerdict::kOk);
    mesh.Commit();
  }
  // 5.2 at a leg: 2.2 from the last, beyond 5 from the first.
  EXPECT_EQ(lifted(&mesh, 5.2), MoveVerdict::kTurned);
  limits.max_turn_from_start = kPi;
  EditableMesh free(shapes::Box({2, 2, 2}), limits);
  for (double degrees = 1.5; degrees < 12.0; degrees += 1.5) {
    ASSERT_EQ(lifted(&free, degrees), MoveVerdict::kOk);
    free.Commit();
  }
}

TEST(EditableMesh, AFaceMayBecomeAsFlatAsAThousandthOfItsLongestEdge) {
  // A tetrahedron over a triangle whose height, 1 on an edge of 2, is pressed down.
  const TriangleMesh start{{{-1, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0.25, 1}},
                           {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
  MoveLimits limits = OnlyIntersections();
  limits.check_intersections = false;
  limits.min_height = MoveLimits().min_height;
  EXPECT_EQ(limits.min_height, 1e-3);
  EditableMesh mesh(start, limits);
  EXPECT_EQ(mesh.TryMove(2, {0, 0.00199, 0}), MoveVerdict::kDegenerate);
  EXPECT_EQ(mesh.TryMove(2, {0, 0.00201, 0}), MoveVerdict::kOk);
}

TEST(EditableMesh, IntersectionsAreRefusedUnlessTheLimitsAllowThem) {
  // A corner of a flat box pushed through its other side.
  EditableMesh mesh(shapes::Box({1.0, 1.0, 0.1}), OnlyIntersections());
  const VertexMove through{0, mesh.Position(0) + Vector3d(0.3, 0.3, 0.3)};
  EXPECT_EQ(mesh.TryMove(std::span(&through, 1)), MoveVerdict::kIntersects);
  EXPECT_EQ(mesh.Position(0), InSinglePrecision(shapes::Box({1.0, 1.0, 0.1})).vertices[0]);
  EXPECT_FALSE(SelfIntersects(mesh.mesh()));
  MoveLimits limits = OnlyIntersections();
  limits.check_intersections = false;
  EditableMesh unchecked(shapes::Box({1.0, 1.0, 0.1}), limits);
  EXPECT_EQ(unchecked.TryMove(std::span(&through, 1)), MoveVerdict::kOk);
  EXPECT_TRUE(SelfIntersects(unchecked.mesh()));
}

TEST(EditableMesh, MovesSeveralVerticesTogether) {
  EditableMesh mesh(shapes::Box({2, 2, 2}));
  std::vector<VertexMove> moves;
  for (std::int32_t v = 0; v < 8; ++v) moves.push_back({v, mesh.Position(v) + Vector3d(9, 9, 9)});
  // One by one the box would fold over.
  EXPECT_EQ(mesh.TryMove(moves), MoveVerdict::kOk);
  EXPECT_NEAR(Volume(mesh.mesh()), 8.0, 1e-5);
  mesh.Commit();
  EXPECT_EQ(WhyNotSolid(Inspect(mesh.mesh())), "");
  EXPECT_EQ(mesh.FirstHit({9, 9, 9}, Vector3d::UnitX())->distance, 1.0);
}

TEST(EditableMesh, FindsTheFacesOfAVertexAndHoldsWhatAnStlFileHolds) {
  const EditableMesh mesh(Transformed(shapes::Sphere(1.0, 1), 1.0 / 3, Vector3d(0.1, 0.2, 0.3)));
  for (std::int32_t v = 0; v < mesh.num_vertices(); ++v) {
    const auto faces = mesh.FacesOf(v);
    EXPECT_EQ(faces.size(), v < 12 ? 5u : 6u);
    for (const std::int32_t f : faces) {
      const auto& face = mesh.mesh().faces[f];
      EXPECT_TRUE(face[0] == v || face[1] == v || face[2] == v);
    }
    EXPECT_EQ(mesh.Position(v), InSinglePrecision(mesh.Position(v)));
  }
}

TEST(EditableMesh, ASliverMayLoseHalfOfItsHeight) {
  EditableMesh mesh(shapes::Box({1.0, 1.0, 1e-4}));
  const Vector3d corner = mesh.Position(0);
  const Vector3d inwards(0, 0, corner.z() > 0 ? -1e-4 : 1e-4);
  EXPECT_EQ(mesh.TryMove(0, corner + 0.4 * inwards), MoveVerdict::kOk);
  mesh.Commit();
  EXPECT_EQ(mesh.TryMove(0, corner + 0.6 * inwards), MoveVerdict::kDegenerate);
}

TEST(Validity, RoundsEveryCoordinateToWhatAFloatHolds) {
  const Vector3d rounded = InSinglePrecision(Vector3d(1.0 / 3, -1.0 / 3, 0.1));
  EXPECT_EQ(rounded, Vector3d(0x1.555556p-2, -0x1.555556p-2, 0x1.99999ap-4));
  EXPECT_FALSE(InSinglePrecision(Vector3d(1e300, 0, 0)).allFinite());
}

TEST(Validity, TellsWhyAMeshCannotBePrinted) {
  EXPECT_EQ(WhyNotPrintable(shapes::Cube()), "");
  EXPECT_NE(WhyNotPrintable(shapes::FlatSquare()), "");
  EXPECT_NE(WhyNotPrintable(shapes::Inverted(shapes::Cube())), "");
  EXPECT_EQ(FaceHeight({0, 0, 0}, {2, 0, 0}, {1, 1, 0}), 0.5);
  EXPECT_EQ(FaceHeight({0, 0, 0}, {2, 0, 0}, {1, 0, 0}), 0.0);
  EXPECT_EQ(FaceHeight({0, 0, 0}, {0, 0, 0}, {0, 0, 0}), 0.0);
  EXPECT_EQ(Name(MoveVerdict::kIntersects), "intersects");
}

}  // namespace
}  // namespace antigrasp
