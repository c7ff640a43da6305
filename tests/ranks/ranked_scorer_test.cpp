#include "antigrasp/ranks/ranked_scorer.h"

#include <gtest/gtest.h>
#include <torch/types.h>

#include <numeric>
#include <string>

#include "antigrasp/core/error.h"
#include "antigrasp/datasets/prior_set.h"
#include "antigrasp/ranks/ranked_share.h"
#include "tests/ranks/fake_group.h"

namespace antigrasp {
namespace {

RunConfig Quick() {
  RunConfig config;
  config.threads = 1;
  config.metric.num_grasps = 5;
  config.metric.num_draws = 3;
  return config;
}

// Seven cylinders and an empty grid.
torch::Tensor Values(const RunConfig& config) {
  PriorSetOptions options;
  options.kind = "cylinders";
  options.count = 7;
  options.resolution = config.model.resolution;
  const torch::Tensor some = NetworkValuesOf(MakePriorSet(options), config.model, "test");
  return torch::cat({some, torch::full_like(some.slice(0, 0, 1), -1.0)});
}

TEST(ScoreTogether, GivesRankZeroWhatOneProcessGets) {
  const RunConfig config = Quick();
  const torch::Tensor values = Values(config);
  SilentObserver silent;
  const ScoredStage alone = ScoreStage(values, config, "", &silent);
  ThreadRanks(3).Run([&](RankGroup* group) {
    RankedShare share(group);
    const ScoredStage shared = ScoreTogether(&share, 4, values, config, nullptr, nullptr);
    if (!group->leads()) return;
    EXPECT_EQ(StageScoresCsv(0, shared), StageScoresCsv(0, alone));
    for (std::size_t i = 0; i < alone.objects.size(); ++i) {
      EXPECT_EQ(shared.objects[i].status, alone.objects[i].status);
      EXPECT_EQ(shared.objects[i].mesh.vertices, alone.objects[i].mesh.vertices);
      EXPECT_EQ(shared.objects[i].mesh.faces, alone.objects[i].mesh.faces);
    }
  });
}

TEST(TakeScored, RefusesWhatIsCutShortTooLongOrForMoreSamples) {
  const RunConfig config = Quick();
  const torch::Tensor values = Values(config).slice(0, 6, 8);
  SilentObserver silent;
  const ScoredStage two = ScoreStage(values, config, "", &silent);
  const std::string bytes = BytesOf(two);
  ScoredStage taken = two;
  TakeScored(bytes, 0, &taken);
  EXPECT_EQ(StageScoresCsv(0, taken), StageScoresCsv(0, two));
  EXPECT_THROW(TakeScored(bytes, 1, &taken), RuntimeFailure);
  EXPECT_THROW(TakeScored(bytes + "x", 0, &taken), RuntimeFailure);
  for (const std::size_t size :
       {std::size_t{0}, std::size_t{7}, bytes.size() / 2, bytes.size() - 1}) {
    EXPECT_THROW(TakeScored(bytes.substr(0, size), 0, &taken), RuntimeFailure) << size;
  }
}

}  // namespace
}  // namespace antigrasp
