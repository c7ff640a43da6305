#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace antigrasp {

// Where a run keeps its files (docs/formats.md).
struct RunFolder {
  std::filesystem::path root;

  std::filesystem::path Config() const { return root / "config.toml"; }
  std::filesystem::path Provenance() const { return root / "provenance.toml"; }
  std::filesystem::path Prior() const { return root / "prior.h5"; }
  std::filesystem::path PriorScores() const { return root / "prior_scores.csv"; }
  std::filesystem::path Latest() const { return root / "checkpoint.pt"; }
  std::filesystem::path Statistics() const { return root / "statistics.csv"; }
  std::filesystem::path Events() const { return root / "tensorboard/events.out.tfevents.0.run"; }
  std::filesystem::path Stl() const { return root / "stl"; }
  std::filesystem::path Control() const { return root / "control"; }
  std::filesystem::path Episode(int episode) const {
    return root / ("episode_" + std::to_string(episode));
  }
  std::filesystem::path EpisodeCheckpoint(int e) const { return Episode(e) / "checkpoint.pt"; }
  std::filesystem::path Losses(int episode) const { return Episode(episode) / "losses.csv"; }
  std::filesystem::path Elites(int episode) const { return Episode(episode) / "elites.h5"; }
  std::filesystem::path Scores(int stage) const {  // -1: of the prior set
    return stage < 0 ? PriorScores() : Episode(stage) / "scores.csv";
  }

  bool HoldsARun() const { return std::filesystem::exists(Config()); }
  // A run, or what is left of one when its tables alone were kept.
  bool HoldsTables() const { return HoldsARun() || std::filesystem::exists(Statistics()); }

  std::vector<std::filesystem::path> Episodes() const;  // the folders that are there

  // Deletes what a run writes and nothing else that may lie in the folder. InputError when another
  // process trains the run.
  void Remove() const;
};

}  // namespace antigrasp
