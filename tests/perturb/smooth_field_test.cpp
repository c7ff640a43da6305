#include "antigrasp/perturb/smooth_field.h"

#include <gtest/gtest.h>

#include <cmath>

#include "antigrasp/core/rng.h"
#include "antigrasp/datasets/roughness.h"
#include "antigrasp/perturb/change_budget.h"
#include "antigrasp/perturb/mesh_change.h"
#include "antigrasp/perturb/search_objective.h"
#include "antigrasp/perturb/subdivide.h"
#include "antigrasp/perturb/validity.h"
#include "tests/support/shapes.h"

// Fields of moves, and the budget that they keep.
namespace antigrasp {
namespace {

using Eigen::MatrixX3d;
using Eigen::Vector3d;

MatrixX3d Random(Eigen::Index rows, double size, std::uint64_t seed) {
  RngStream rng(seed, "field-test");
  MatrixX3d out(rows, 3);
  for (double& x : out.reshaped()) x = size * rng.Normal();
  return out;
}

TriangleMesh FineCube() { return SplitLongEdges(shapes::Cube(), 0.15); }

TEST(SmoothField, MovesACentreByItsVectorAndOthersAsABellFallsOff) {
  const TriangleMesh box = shapes::Box({3, 4, 12});  // diagonal 13
  const SmoothField field(box, 2.0 / 13, 1);         // one centre, radius 2
  ASSERT_EQ(field.centres(), 1);
  const MatrixX3d moves = field.At(MatrixX3d::Ones(1, 3));
  std::vector<double> squared;
  for (Eigen::Index v = 0; v < moves.rows(); ++v) squared.push_back(-8.0 * std::log(moves(v, 0)));
  std::sort(squared.begin(), squared.end());
  // From a corner: itself, the ends of the edges, of the diagonals of the faces, of the solid's.
  const double expected[] = {0, 9, 16, 25, 144, 153, 160, 169};
  for (std::size_t i = 0; i < squared.size(); ++i) EXPECT_NEAR(squared[i], expected[i], 1e-9);
}

TEST(SmoothField, SpreadsCentresUntilEveryVertexIsNearOne) {
  const TriangleMesh ball = shapes::Sphere(1.0, 3);
  const SmoothField field(ball, 0.12);
  EXPECT_GT(field.centres(), 30);
  EXPECT_LT(field.centres(), 120);
  MatrixX3d nearest(static_cast<Eigen::Index>(ball.vertices.size()), 3);
  nearest.setZero();
  for (Eigen::Index k = 0; k < field.centres(); ++k) {
    MatrixX3d one = MatrixX3d::Zero(field.centres(), 3);
    one(k, 0) = 1.0;
    nearest = nearest.cwiseMax(field.At(one));
  }
  EXPECT_GE(nearest.col(0).minCoeff(), std::exp(-0.5 * 0.7 * 0.7) - 1e-12);
}

TEST(SmoothField, NoVertexMovesFartherThanTheLongestMoveAndShortMovesAreAsTheyAre) {
  const TriangleMesh cube = FineCube();
  const auto rows = static_cast<Eigen::Index>(cube.vertices.size());
  const TriangleMesh far = MovedBy(Random(rows, 50.0, 1), 0.1, 1.0, cube);
  const MatrixX3d small = Random(rows, 1e-5, 2);
  const TriangleMesh near = MovedBy(small, 0.1, 0.5, cube);
  for (std::size_t v = 0; v < cube.vertices.size(); ++v) {
    EXPECT_LE((far.vertices[v] - cube.vertices[v]).norm(), 0.1 + 1e-15);
    const Vector3d expected = 0.5 * 0.1 * small.row(static_cast<Eigen::Index>(v)).transpose();
    EXPECT_LT((near.vertices[v] - cube.vertices[v] - expected).norm(), 1e-14);
  }
}

// Of sum_v w_v . moved_v, for some vectors w: known, and linear in the vertices.
TEST(SmoothField, ItsChainRuleIsThatOfDifferences) {
  const TriangleMesh ball = shapes::Sphere(1.0, 1);
  const SmoothField field(ball, 0.3);
  const MatrixX3d vectors = Random(field.centres(), 0.4, 3);
  const MatrixX3d w = Random(static_cast<Eigen::Index>(ball.vertices.size()), 1.0, 4);
  std::vector<Vector3d> by_vertex;
  for (Eigen::Index v = 0; v < w.rows(); ++v) by_vertex.push_back(w.row(v).transpose());
  const auto value = [&](const MatrixX3d& at) {
    const TriangleMesh moved = MovedBy(field.At(at), 0.2, 1.0, ball);
    double sum = 0.0;
    for (std::size_t v = 0; v < by_vertex.size(); ++v) sum += by_vertex[v].dot(moved.vertices[v]);
    return sum;
  };
  const MatrixX3d slope = field.Back(ByMoves(field.At(vectors), 0.2, by_vertex));
  for (Eigen::Index k = 0; k < field.centres(); k += 5) {
    for (Eigen::Index i = 0; i < 3; ++i) {
      MatrixX3d up = vectors, down = vectors;
      up(k, i) += 1e-6;
      down(k, i) -= 1e-6;
      EXPECT_NEAR(slope(k, i), (value(up) - value(down)) / 2e-6, 1e-8);
    }
  }
}

// The cube with its top shifted along x: every limit's value is known.
TriangleMesh Sheared(double shift) {
  TriangleMesh mesh = FineCube();
  for (Vector3d& v : mesh.vertices) v.x() += shift * (v.z() + 0.5);
  return InSinglePrecision(mesh);
}

TEST(ChangeBudget, NamesTheLimitThatAChangeBreaks) {
  const TriangleMesh cube = FineCube();
  const double diagonal = std::sqrt(3.0);
  ChangeBudget budget{
      .hausdorff = 100 * 0.2 / diagonal + 0.1, .volume = 5, .turn = 12, .roughness = 50};
  // Sides turn by atan(0.2) = 11.31 degrees, corners move by 0.2, the volume stays.
  const TriangleMesh sheared = Sheared(0.2);
  EXPECT_EQ(BudgetKeeper(cube, budget).Broken(cube), "");
  EXPECT_EQ(BudgetKeeper(cube, budget).Broken(sheared), "");
  ChangeBudget less = budget;
  less.turn = 11.3;
  EXPECT_EQ(BudgetKeeper(cube, less).Broken(sheared), "turned");
  less = budget;
  less.hausdorff = 100 * 0.2 / diagonal - 0.1;
  EXPECT_EQ(BudgetKeeper(cube, less).Broken(sheared), "moved too far");
  TriangleMesh taller = cube;
  for (Vector3d& v : taller.vertices) v.z() *= 1.06;
  EXPECT_EQ(BudgetKeeper(cube, budget).Broken(taller), "volume");
  less = budget;
  less.volume = 6.001;
  EXPECT_EQ(BudgetKeeper(cube, less).Broken(taller), "");
}

TEST(ChangeBudget, CountsRoughnessAndRefusesWhatIsNoSolid) {
  const TriangleMesh cube = FineCube();
  ChangeBudget budget{.hausdorff = 20, .volume = 50, .turn = 90, .roughness = 0};
  EXPECT_EQ(BudgetKeeper(cube, budget).Broken(cube), "");
  TriangleMesh bumpy = cube;
  for (Vector3d& v : bumpy.vertices) v.z() += 0.02 * std::sin(20 * v.x());
  EXPECT_EQ(BudgetKeeper(cube, budget).Broken(bumpy), "roughness");
  budget.roughness = 100 * (MeanDihedralAngle(bumpy) / MeanDihedralAngle(cube) - 1) + 1;
  EXPECT_EQ(BudgetKeeper(cube, budget).Broken(bumpy), "");
  TriangleMesh hollow = cube;  // the top is drawn through the bottom
  for (Vector3d& v : hollow.vertices) {
    if (v.z() > 0.4 && std::hypot(v.x(), v.y()) < 0.1) v.z() -= 1.2;
  }
  budget = {.hausdorff = 100, .volume = 90, .turn = 90, .roughness = 1e3};
  EXPECT_NE(BudgetKeeper(cube, budget).Broken(hollow), "");
}

TEST(ChangeBudget, NoPenaltyInsideAndOneThatGrowsTowardsEveryLimit) {
  const TriangleMesh cube = FineCube();
  const std::vector<Vector3d> none(cube.faces.size(), Vector3d::Zero());
  const auto penalty = [&](const ChangeBudget& budget, const TriangleMesh& mesh) {
    std::vector<Vector3d> by_normal = none, by_vertex(mesh.vertices.size(), Vector3d::Zero());
    BudgetKeeper(cube, budget).AddPenalty(mesh, FaceNormals(mesh), &by_normal, &by_vertex);
    double sum = 0.0;  // of what goes on away from the cube
    const std::vector<Vector3d> by_turn = DerivativeByVertices(mesh, by_normal);
    for (std::size_t v = 0; v < by_vertex.size(); ++v) {
      sum += (by_vertex[v] + by_turn[v]).dot(mesh.vertices[v] - cube.vertices[v]);
    }
    return sum;
  };
  const TriangleMesh sheared = Sheared(0.2);  // sides turn by 11.31 degrees
  EXPECT_EQ(penalty({.turn = 14}, sheared), 0.0);
  EXPECT_GT(penalty({.turn = 13}, sheared), 0.0);
  EXPECT_GT(penalty({.turn = 10}, sheared), penalty({.turn = 13}, sheared));
  TriangleMesh larger = Transformed(cube, 1.05, Vector3d::Zero());  // by 15.8 %
  EXPECT_EQ(penalty({.volume = 18}, larger), 0.0);
  EXPECT_GT(penalty({.volume = 17}, larger), 0.0);
  TriangleMesh bumpy = cube;
  for (Vector3d& v : bumpy.vertices) v.z() += 0.02 * std::sin(20 * v.x());
  EXPECT_EQ(penalty({.roughness = 1e3}, bumpy), 0.0);
  EXPECT_GT(penalty({.roughness = 0}, bumpy), 0.0);
}

}  // namespace
}  // namespace antigrasp
