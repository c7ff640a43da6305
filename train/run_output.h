#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "antigrasp/train/run_config.h"
#include "antigrasp/train/run_folder.h"
#include "antigrasp/train/stage.h"

namespace antigrasp {

// What a run writes and says beside its checkpoints.

std::string StageName(int episode);                            // "episode 1"; -1: "prior set"
std::string StageName(int episode, const std::string& doing);  // "episode 1: scoring"

// What TensorBoard shows of a stage.
std::vector<std::pair<std::string, double>> StageScalars(const StageStatistics& row,
                                                         const std::vector<StageStatistics>& rows);

// One line: counts, graspability and kappa against the rows before it.
void LogStage(const StageStatistics& row, const std::vector<StageStatistics>& rows);

// Mode collapse (VI-D) shows in coverage and near-duplicates long before the mean pairwise distance
// moves: warns below half of episode 0's coverage and above 20 % near-duplicates.
void WarnIfCollapsed(const StageStatistics& row, const std::vector<StageStatistics>& rows);

// `values`: network values of the elites as the next episode learns from them; `elites`: which
// samples they are.
void WriteElites(const std::filesystem::path& path, const torch::Tensor& values,
                 const std::vector<std::int64_t>& elites, int episode, const RunConfig& config);

// The first 32 samples that have a surface, usable or not, as a picture.
void WriteSampleSheet(const std::filesystem::path& path, const ScoredStage& scored,
                      const RunConfig& config);

// config.stl_count least graspable objects as STL in mm under RUN/stl, and scores.csv beside them:
// picked by their first score, scored again with fresh draws, because the lowest of many noisy
// scores is too low.
void ExportLeastGraspable(const ScoredStage& scored, const RunConfig& config,
                          const RunFolder& folder);

}  // namespace antigrasp
