#include "antigrasp/train/stepped_run.h"

#include "antigrasp/checkpoints/checkpoint.h"
#include "antigrasp/checkpoints/pretrained.h"
#include "antigrasp/core/error.h"
#include "antigrasp/train/loss_table.h"
#include "antigrasp/train/make_gan.h"
#include "antigrasp/train/run_inputs.h"
#include "antigrasp/train/run_output.h"
#include "antigrasp/train/statistics_table.h"

namespace antigrasp {
namespace {

RunConfig Checked(RunConfig config) {
  Validate(config, "configuration");
  if (config.cem.control) {
    throw InputError("cem.control = true", "configuration",
                     "false: a control is a run of its own, with cem.select = \"random\"");
  }
  RequireFittingStart(config);
  return config;
}

}  // namespace

SteppedRun::SteppedRun(RunConfig config, RunObserver* observer, Judge* judge, MeshRefiner refine)
    : config_(Checked(std::move(config))), observer_(observer), model_(MakeGan(config_)) {
  const torch::Tensor prior =
      NetworkValuesOf(PriorOf(config_, observer), config_.model, config_.prior_file);
  loop_ = std::make_unique<CemLoop>(config_, model_.get(), prior,
                                    judge != nullptr ? JudgedScorer(config_, judge, observer)
                                                     : GraspabilityScorer(config_, observer),
                                    observer, InThreads(std::move(refine)));
  if (!config_.start.empty()) {
    const std::filesystem::path networks = FindNetworks(config_.start);
    model_->LoadNetworks(ReadCheckpoint(networks).networks, networks.string());
  }
  loop_->Begin();
}

SteppedRun::~SteppedRun() = default;

const Episode* SteppedRun::Next() {
  if (loop_->rows().empty()) loop_->ScorePrior("the prior set");
  if (episode_) {
    if (loop_->last()) return nullptr;
    loop_->Next(*episode_);
    episode_.reset();
  }
  const ProgressFn progress = observer_->Phase(StageName(model_->episode(), "training"));
  while (!loop_->trained()) {
    loop_->TrainStep();
    progress(model_->step(), model_->iterations());
  }
  episode_ = loop_->Finish();
  return &*episode_;
}

const std::vector<StageStatistics>& SteppedRun::rows() const { return loop_->rows(); }

void SteppedRun::Save(const std::filesystem::path& path) const {
  Checkpoint checkpoint;
  checkpoint.config = ToToml(config_);
  checkpoint.statistics = StatisticsToCsv(loop_->rows());
  checkpoint.shapes = loop_->shapes();
  checkpoint.losses = LossTensor({model_->ScalarNames(), {}});
  checkpoint.networks = model_->State();
  WriteCheckpoint(path, checkpoint);
}

}  // namespace antigrasp
