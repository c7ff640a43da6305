#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

#include "antigrasp/core/observer.h"
#include "antigrasp/quality/judge.h"
#include "antigrasp/train/cem_loop.h"
#include "antigrasp/train/control_run.h"
#include "antigrasp/train/make_gan.h"
#include "antigrasp/train/run_config.h"
#include "antigrasp/train/run_folder.h"
#include "antigrasp/train/run_inputs.h"
#include "antigrasp/train/selection.h"
#include "antigrasp/train/statistics.h"

namespace antigrasp {

// What a finished run (and its control, if it had one) measured.
struct RunResult {
  std::vector<StageStatistics> stages;
  std::vector<StageStatistics> control;
};

// Who scores the samples of a run whose cem.score is not "epsilon"; made before the work begins.
using JudgeMaker = std::function<std::unique_ptr<Judge>(const RunConfig&)>;

// Puts another scorer in the place of the usual one (nullptr: the metric scores). What it is given
// stays as long as it does.
using ScorerMaker =
    std::function<StageScorer(const RunConfig& config, Judge* judge, RunObserver* observer)>;

// What settings ask of the program that trains, besides the model.
struct RunParts {
  JudgeMaker make_judge;          // of a run whose cem.score is not "epsilon"
  EliteRefiner refine;            // of a run with cem.refine_steps
  ScorerMaker make_scorer = {};   // of one that shares its samples out
  PriorMaker make_prior = {};     // of one that shares that out
  BesideStarter run_beside = {};  // of the control, while the run goes on
};

// The CEM + GAN algorithm (V-B, VI-C): train the GAN on the prior set, then repeatedly sample,
// remesh, reject, score, keep the least graspable and retrain. `make` puts another shape model in
// the GAN's place. Every file lands in `folder`, every step of it can be interrupted and resumed
// with equal bytes on the CPU at equal threads.
// InputError: the folder already holds a run, another process trains it (train/run_lock.h), the
// prior file is unusable, or config.start has networks of another model or, without
// config.fine_tune, of another prior set. Interrupted: state saved. RuntimeFailure: non-finite
// losses, no usable sample or a judge that stopped; the last checkpoint is intact.
RunResult StartRun(const RunConfig& config, const std::filesystem::path& folder,
                   RunObserver* observer, const ShapeModelMaker& make = MakeGan,
                   const RunParts& parts = {});

// What StartRun refuses of its inputs, for those who make room for a run first: InputError when the
// prior file or the networks to begin with are missing, do not fit or lie in `folder`.
void RequireInputs(const RunConfig& config, const std::filesystem::path& folder);

// Goes on where the folder's last checkpoint stands; a finished run only reports its numbers. What
// a killed process left half written is removed. InputError: another process trains the run.
// `make`, `parts`: as the run was started with.
RunResult ResumeRun(const std::filesystem::path& folder, RunObserver* observer,
                    const ShapeModelMaker& make = MakeGan, const RunParts& parts = {});

// The configuration the run in `folder` was started with. InputError when there is none.
RunConfig ConfigOfRun(const std::filesystem::path& folder);

}  // namespace antigrasp
