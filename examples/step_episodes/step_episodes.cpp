// Steps the episode loop with a score of its own and without a folder: step_episodes [NETWORKS]
// Pretrained networks that draw cylinders stay as they are; episode by episode their z is drawn
// around that of the least round objects.
#include <antigrasp/checkpoints/checkpoint.h>
#include <antigrasp/checkpoints/pretrained.h>
#include <antigrasp/train/cem_loop.h>
#include <antigrasp/train/make_gan.h>

#include <cmath>
#include <cstdio>
#include <exception>

// The score: the lowest are kept. 1 for a ball; the less, the more surface for the volume.
static double Roundness(const antigrasp::TriangleMesh& mesh) {
  const double area = antigrasp::SurfaceArea(mesh), volume = antigrasp::Volume(mesh);
  return std::cbrt(36.0 * M_PI * volume * volume) / area;
}

int main(int argc, char** argv) {
  using namespace antigrasp;
  try {
    const std::filesystem::path file = FindNetworks(argc > 1 ? argv[1] : "cylinders-prior");
    const Checkpoint networks = ReadCheckpoint(file);
    RunConfig config;
    config.model = NetworksFromToml(networks.config, file.string()).model;
    config.start = file.string();            // networks that there are: none are trained first
    config.cem.mode = EpisodeMode::kLatent;  // nor later
    config.cem.episodes = 3;
    config.cem.samples = 64;
    config.cem.keep = 8;
    config.cem.prior_scored = 0;  // all

    // A model, a prior set and a scorer go in. The model may be any other ShapeModel.
    const std::unique_ptr<ShapeModel> model = MakeGan(config);
    model->LoadNetworks(networks.networks, file.string());
    const ShapeSet cylinders = MakePriorSet({.count = 32});
    const torch::Tensor prior = NetworkValuesOf(cylinders, config.model, "cylinders");
    const StageScorer scorer = [&](const torch::Tensor& values, const std::string&) {
      return ScoreStageBy(Roundness, values, config, /*progress=*/nullptr);
    };
    SilentObserver observer;
    CemLoop loop(config, model.get(), prior, scorer, &observer);
    loop.Begin();
    loop.ScorePrior("cylinders");
    while (true) {
      while (!loop.trained()) loop.TrainStep();  // not once in this mode
      const Episode episode = loop.Finish();     // sampled, scored, elites chosen
      if (loop.last()) break;
      loop.Next(episode);
    }
    std::printf("networks %s\n", file.c_str());
    for (const StageStatistics& row : loop.rows()) {  // stages come out; -1 is the prior set
      std::printf("stage %d: roundness %.3f of %d objects\n", row.stage, row.graspability.mean,
                  row.scored);
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "step_episodes: %s\n", error.what());
    return 2;
  }
}
