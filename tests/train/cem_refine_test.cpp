// Runs whose elites are changed before they are learnt from.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <set>

#include "antigrasp/checkpoints/checkpoint.h"
#include "antigrasp/core/error.h"
#include "antigrasp/datasets/shape_set.h"
#include "antigrasp/models/sdf_values.h"
#include "antigrasp/train/cem_loop.h"
#include "antigrasp/train/cem_run.h"
#include "antigrasp/train/prior_similarity.h"
#include "antigrasp/train/sample_set.h"
#include "tests/support/shapes.h"
#include "tests/support/temp_folder.h"
#include "tests/train/run_files.h"
#include "tests/train/sphere_model.h"
#include "tests/train/tiny_run.h"

namespace antigrasp {
namespace {

using shapes::StoppingObserver;
using shapes::TempFolder;

TEST(CemRefine, ElitesAreRefinedInTheRunAndNotInItsControl) {
  const TempFolder folder;
  StoppingObserver observer;
  RunConfig config = shapes::Tiny();
  config.cem.episodes = 1;
  config.cem.prior_fraction = 0.0;
  config.cem.control = true;
  config.cem.refine_steps = 3;
  EXPECT_THROW(StartRun(config, folder / "run", &observer), InputError);
  std::atomic<int> refined = 0;
  const TriangleMesh sphere = shapes::Sphere(0.3, 3);
  const MeshRefiner rounded = [&](const TriangleMesh&, const RunConfig& of, const BoundingBox&,
                                  std::uint64_t) {
    EXPECT_EQ(of.cem.select, EliteOrder::kGraspability);
    ++refined;
    return sphere;
  };
  const RunResult result =
      StartRun(config, folder / "run", &observer, MakeGan, {nullptr, InThreads(rounded)});
  const RunFolder run{folder / "run"};
  int elites = 0;
  for (int episode = 0; episode <= config.cem.episodes; ++episode) {
    elites += static_cast<int>(ReadShapeSet(run.Elites(episode)).grids.size());
  }
  EXPECT_GT(elites, 0);
  EXPECT_EQ(refined, elites);
  EXPECT_EQ(ConfigOfRun(run.Control()).cem.refine_steps, 0);
  // What the next episode learns from are spheres of 4/3 pi 0.3^3 32^3 nodes.
  for (const SdfGrid& grid : ReadShapeSet(run.Elites(0)).grids) {
    const auto inside =
        std::count_if(grid.values.begin(), grid.values.end(), [](float v) { return v > 0.0F; });
    EXPECT_NEAR(static_cast<double>(inside), 3706.0, 60.0);
  }
}

// Spheres of radius 0.2, 0.21, ... 0.27, as network values.
torch::Tensor PriorSpheres(const RunConfig& config) {
  std::vector<torch::Tensor> spheres;
  for (int i = 0; i < 8; ++i) {
    const torch::Tensor distances = 0.2 + 0.01 * i - shapes::Radii(config.model.resolution);
    spheres.push_back(NetworkValues(distances, config.model));
  }
  return torch::stack(spheres).to(torch::kHalf);
}

double Volume(const TriangleMesh& mesh) {
  double sixfold = 0.0;
  for (const auto& face : mesh.faces) {
    sixfold += mesh.vertices[static_cast<std::size_t>(face[0])].dot(
        mesh.vertices[static_cast<std::size_t>(face[1])].cross(
            mesh.vertices[static_cast<std::size_t>(face[2])]));
  }
  return sixfold / 6.0;
}

// The smaller a sphere, the lower its score: parts shrink until the spread of the prior set ends,
// a hundredth below its smallest sphere. z alone draws radii of 4/5 to 6/5 of 0.235.
TEST(CemRefine, LatentModeMovesPartsToLowerScoresWithinThePriorsSpread) {
  RunConfig config = shapes::Tiny();
  config.cem.mode = EpisodeMode::kLatent;
  config.cem.spread = 100.0;
  config.cem.prior_fraction = 0.0;
  config.cem.samples = 16;
  config.cem.keep = 6;
  config.cem.part_step = 0.1;
  config.cem.refine_steps = 60;
  shapes::SphereModel model(config, /*part_numbers=*/2);
  StoppingObserver observer;
  const StageScorer by_volume = [&](const torch::Tensor& values, const std::string&) {
    return ScoreStageBy(Volume, values, config, nullptr);
  };
  CemLoop loop(config, &model, PriorSpheres(config), by_volume, &observer);
  loop.Begin();
  loop.ScorePrior("spheres");
  while (!loop.trained()) loop.TrainStep();
  const Episode episode = loop.Finish();
  const std::int64_t latent = config.model.latent;
  ASSERT_EQ(episode.latents.size(0), std::ssize(episode.selection.elites));
  ASSERT_EQ(episode.latents.size(1), latent + 2);
  const torch::Tensor sampled =
      model.Latents(StageSeed(config, 0), 0, config.cem.samples)
          .index_select(0, torch::tensor(episode.selection.elites, torch::kLong));
  EXPECT_TRUE(torch::equal(episode.latents.narrow(1, 0, latent), sampled));
  EXPECT_TRUE(torch::equal(episode.elites, model.Draw(episode.latents)));
  for (const torch::Tensor& elite : episode.elites.split(1)) {
    EXPECT_NEAR(model.MeanRadius(elite), 0.19, 0.005);
  }
  loop.Next(episode);
  ASSERT_EQ(model.latent().means.size(1), latent + 2);
  EXPECT_TRUE(torch::equal(model.latent().means.narrow(1, latent, 2),
                           episode.latents.narrow(1, latent, 2)));
  const torch::Tensor stray = model.latent().deviations.narrow(1, latent, 2);
  EXPECT_NEAR(stray.max().item<double>(), config.cem.step * config.cem.part_step, 1e-7);
}

// Every prior sphere is a niche with room for one. Elites that are in the niche of another.
std::size_t Crowded(double admits) {
  RunConfig config = shapes::Tiny();
  config.cem.mode = EpisodeMode::kLatent;
  config.cem.spread = 100.0;
  config.cem.samples = config.cem.keep = 8;
  config.cem.part_step = 0.1;
  config.cem.refine_steps = 60;
  config.cem.refine_niches = 8;
  config.cem.refine_admits = admits;
  shapes::SphereModel model(config, /*part_numbers=*/2);
  StoppingObserver observer;
  const StageScorer by_volume = [&](const torch::Tensor& values, const std::string&) {
    return ScoreStageBy(Volume, values, config, nullptr);
  };
  const torch::Tensor prior = PriorSpheres(config);
  CemLoop loop(config, &model, prior, by_volume, &observer);
  loop.Begin();
  loop.ScorePrior("spheres");
  while (!loop.trained()) loop.TrainStep();
  const torch::Tensor elites = loop.Finish().elites;
  const std::vector<std::int64_t> nearest = NearestRows(elites, prior.flatten(1).to(torch::kFloat));
  EXPECT_GE(nearest.size(), 7U);
  return nearest.size() - std::set<std::int64_t>(nearest.begin(), nearest.end()).size();
}

TEST(CemRefine, NichesKeepMovedPartsAsSpreadAsThePriorSet) {
  EXPECT_EQ(Crowded(100.0), 0U);  // none of the sizes is left for the smallest
}

TEST(CemRefine, NichesThatAdmitOnlyWhatScoresLowerLeaveSizesForTheSmallest) {
  EXPECT_GT(Crowded(0.0), 0U);
}

RunConfig TinySolids() {
  RunConfig config = shapes::Tiny();
  config.model.kind = ModelKind::kSolids;
  config.model.parts = 2;
  config.cem.mode = EpisodeMode::kLatent;
  config.cem.part_step = 0.5;
  config.cem.refine_steps = 2;
  config.cem.refine_niches = 3;
  config.cem.episodes = 1;
  config.cem.keep = 6;
  return config;
}

std::vector<SdfGrid> Sampled(const std::filesystem::path& networks, bool unmoved) {
  SampleRequest request;
  request.networks = networks.string();
  request.unmoved = unmoved;
  return SampledNetworks(request).Sample(5, 1, 3);
}

TEST(CemRefine, SamplesOfMovedPartsHaveAPairOfTheSameZUnmoved) {
  const TempFolder folder;
  StoppingObserver observer;
  RunConfig wanted = TinySolids();
  wanted.cem.control = true;
  wanted.cem.refine_admits = 90.0;
  StartRun(wanted, folder / "run", &observer);
  const RunFolder run{folder / "run"};
  EXPECT_EQ(ConfigOfRun(run.Control()).cem.refine_niches, 0);
  EXPECT_NO_THROW(Validate(ConfigOfRun(run.Control()), "the control"));
  const std::filesystem::path last = run.EpisodeCheckpoint(1);
  const std::vector<SdfGrid> moved = Sampled(last, false), pairs = Sampled(last, true);
  ASSERT_EQ(moved.size(), pairs.size());
  const RunConfig config = ConfigOfRun(run.root);
  GanTrainer trainer(config.model, config.gan, config.seed, torch::kCPU);
  trainer.LoadNetworks(ReadCheckpoint(last).networks, "last");
  const torch::Tensor latents = trainer.Latents(5, 1, 3);
  ASSERT_EQ(latents.size(1), config.model.latent + 2 * 19);
  const torch::Tensor drawn = trainer.Draw(latents.narrow(1, 0, config.model.latent));
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    EXPECT_EQ(pairs[i].values, GridOf(drawn[static_cast<std::int64_t>(i)], config.model).values);
    EXPECT_NE(pairs[i].values, moved[i].values);
  }
  // Of episode 0 nothing was moved.
  EXPECT_THROW(Sampled(run.EpisodeCheckpoint(0), true), InputError);
}

TEST(CemRefine, ARunStoppedWhileItRefinesPartsGoesOnToTheSameFiles) {
  const TempFolder folder;
  StoppingObserver never;
  StartRun(TinySolids(), folder / "whole", &never);
  // 8 shapes made, 4 scored, 20 updates; a stage: all samples drawn, 8 scored, two trials.
  shapes::RunWithStops(TinySolids(), folder / "stopped",
                       {{8 + 4 + 20 + 1 + 8 + 1, "episode 0: refining the elites"},
                        {1 + 8 + 2 + 1 + 8, "episode 1: refining the elites"}});
  shapes::ExpectSameFiles(folder / "whole", folder / "stopped");
}

}  // namespace
}  // namespace antigrasp
