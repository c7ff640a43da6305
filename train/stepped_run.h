#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "antigrasp/train/cem_loop.h"

namespace antigrasp {

// A run an episode at a time and without a folder. Its numbers are those of StartRun with the same
// configuration, but that it has no control.
class SteppedRun {
 public:
  // `judge`: scores the samples, lower = kept; nullptr: the metric does. It and the observer stay
  // as long as this. InputError for a configuration that does not fit, with cem.control, and for
  // inputs as RequireInputs.
  SteppedRun(RunConfig config, RunObserver* observer, Judge* judge = nullptr,
             MeshRefiner refine = nullptr);
  ~SteppedRun();

  // Trains, samples and scores the next episode, the first time also the prior set; nullptr after
  // the last. It stays until the next call. RuntimeFailure as CemLoop; what an observer's progress
  // throws leaves the run where it was before the step that it interrupted.
  const Episode* Next();

  const RunConfig& config() const { return config_; }
  // Of the stages so far, the prior set's (-1) first.
  const std::vector<StageStatistics>& rows() const;
  // The networks as they are now, as a checkpoint that sampling and other runs begin with.
  void Save(const std::filesystem::path& path) const;

 private:
  const RunConfig config_;
  RunObserver* observer_;
  std::unique_ptr<ShapeModel> model_;
  std::unique_ptr<CemLoop> loop_;
  std::optional<Episode> episode_;
};

}  // namespace antigrasp
