#include "antigrasp/perturb/pair_sampler.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "tests/perturb/perturbed_shapes.h"
#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

TEST(PairSampler, DrawsOnlyAntipodalPairsHoweverItDraws) {
  RngStream rng(1, "sampler");
  const EditableMesh mesh(shapes::Torus(1.0, 0.4, 24, 12));
  for (const PairDraw draw : {PairDraw::kUniform, PairDraw::kArea, PairDraw::kRay}) {
    const PairLimits limits{0.4, 1.0};
    const PairSampler sampler(mesh, limits, draw);
    for (int i = 0; i < 300; ++i) {
      const auto pair = sampler.Draw(&rng);
      ASSERT_TRUE(pair);
      EXPECT_TRUE(AntipodalTest(limits)(mesh.Shape(pair->first), mesh.Shape(pair->second)));
    }
  }
}

TEST(PairSampler, UniformDrawsEveryPairEquallyOften) {
  RngStream rng(2, "sampler");
  const EditableMesh mesh(shapes::Box({1, 1, 5}));
  const PairSampler sampler(mesh, {}, PairDraw::kUniform);
  const auto pairs = AntipodalPairs(mesh.mesh(), {});
  std::map<FacePair, int> counts;
  const int draws = 200 * static_cast<int>(pairs.size());
  for (int i = 0; i < draws; ++i) {
    const auto pair = sampler.Draw(&rng);
    ASSERT_TRUE(pair);
    ++counts[{std::min(pair->first, pair->second), std::max(pair->first, pair->second)}];
  }
  EXPECT_EQ(counts.size(), pairs.size());
  for (const auto& [pair, count] : counts) EXPECT_NEAR(count, 200, 5 * std::sqrt(200));
}

TEST(PairSampler, RaysAndAreasPreferLargeSides) {
  RngStream rng(3, "sampler");
  // The two square sides of the slab have 10 / 12 of its area, and all pairs of long rays.
  EditableMesh mesh(shapes::Box({1, 1, 0.1}));
  for (const PairDraw draw : {PairDraw::kArea, PairDraw::kRay}) {
    const PairSampler sampler(mesh, {}, draw);
    int large = 0;
    for (int i = 0; i < 1000; ++i) {
      const auto pair = sampler.Draw(&rng);
      ASSERT_TRUE(pair);
      large += std::abs(mesh.Normal(pair->first).z()) > 0.9;
    }
    EXPECT_GT(large, 850);
  }
}

TEST(PairSampler, DrawsPairsInProportionToTheProductOfTheirAreas) {
  RngStream rng(5, "sampler");
  // Triangles of 1 / 2 on the squares and of 1 / 4 on the four sides: 4 pairs of weight 1 / 4 and
  // 8 of 1 / 16, so that two thirds of the draws are of the squares. (One face by area alone would
  // give a half, none a third, areas squared eight ninths.)
  const EditableMesh mesh(shapes::Box({1, 1, 0.5}));
  const PairSampler sampler(mesh, {}, PairDraw::kArea);
  int large = 0;
  constexpr int kDraws = 4000;
  for (int i = 0; i < kDraws; ++i) {
    large += std::abs(mesh.Normal(sampler.Draw(&rng)->first).z()) > 0.9 ? 1 : 0;
  }
  EXPECT_NEAR(large / static_cast<double>(kDraws), 2.0 / 3.0, 0.035);  // 5 standard errors
}

TEST(PairSampler, ARayLeavesThroughTheFaceItNames) {
  RngStream rng(6, "sampler");
  // Between the two plates of a U a ray would leave the object, and enter it again: it is the first
  // face from inside that counts, half a unit away, not the outermost one.
  const TriangleMesh first = shapes::Box({1, 1, 0.5});
  const EditableMesh mesh(shapes::Joined(first, Transformed(first, 1.0, {0, 0, 2})));
  const PairSampler sampler(mesh, {0.1}, PairDraw::kRay);
  for (int i = 0; i < 200; ++i) {
    const auto pair = sampler.Draw(&rng);
    ASSERT_TRUE(pair);
    EXPECT_EQ(pair->first < 12, pair->second < 12);
    EXPECT_LT(mesh.Normal(pair->first).dot(mesh.Normal(pair->second)), -0.99);
  }
  // Rays are not longer than the jaws open: 0.6 is between the plate's height and its sides.
  const PairSampler narrow(mesh, {0.1, 0.6}, PairDraw::kRay);
  for (int i = 0; i < 100; ++i) {
    EXPECT_GT(std::abs(mesh.Normal(narrow.Draw(&rng)->first).z()), 0.9);
  }
}

TEST(PairSampler, FollowsAMovedMeshAndKnowsWhenThereIsNoPair) {
  RngStream rng(4, "sampler");
  const EditableMesh tetrahedron(shapes::RegularTetrahedron());
  for (const PairDraw draw : {PairDraw::kUniform, PairDraw::kArea, PairDraw::kRay}) {
    EXPECT_FALSE(PairSampler(tetrahedron, {}, draw).Draw(&rng));
  }
  EXPECT_FALSE(PairSampler(EditableMesh({}), {}, PairDraw::kArea).Draw(&rng));
  EditableMesh mesh(shapes::Box({1, 1, 1}));
  PairSampler sampler(mesh, {}, PairDraw::kArea);
  std::vector<VertexMove> moves;
  for (std::int32_t v = 0; v < 8; ++v) {
    Eigen::Vector3d to = mesh.Position(v);
    to.z() *= 100;
    moves.push_back({v, to});
  }
  ASSERT_EQ(mesh.TryMove(moves), MoveVerdict::kOk);
  sampler.Update(mesh.ChangedFaces());
  for (int i = 0; i < 50; ++i) EXPECT_LT(std::abs(mesh.Normal(sampler.Draw(&rng)->first).z()), 0.5);
}

}  // namespace
}  // namespace antigrasp
