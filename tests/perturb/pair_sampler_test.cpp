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
  for (const char* name : {"uniform", "area", "ray"}) {
    const PairLimits limits{0.4, 1.0};
    const PairSampler sampler(mesh, limits, PairDrawOf(name));
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

TEST(PairSampler, FollowsAMovedMeshAndKnowsWhenThereIsNoPair) {
  RngStream rng(4, "sampler");
  const EditableMesh tetrahedron(shapes::RegularTetrahedron());
  for (const char* name : {"uniform", "area", "ray"}) {
    EXPECT_FALSE(PairSampler(tetrahedron, {}, PairDrawOf(name)).Draw(&rng));
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
