#pragma once

#include "antigrasp/core/observer.h"
#include "antigrasp/report/run_stages.h"

namespace antigrasp {

// Which samples of a stage the gallery shows.
struct GalleryChoice {
  std::vector<std::int64_t> indices;  // ascending
  std::vector<bool> least;            // one of the least graspable; else drawn at random
  std::string note;                   // how they were chosen
};

// Half of `per_stage` drawn at random from the usable ones of `scores` (seeded by stage) and half
// the least graspable of the others. Without scores all at random from `samples`.
GalleryChoice ChooseSamples(const std::vector<ScoreRow>& scores, int samples, int stage,
                            int per_stage, std::uint64_t seed);

// Adds the gallery to the report: of every stage that can be made again a group and its objects,
// with the grasps that the run evaluated. What cannot be made, or scores otherwise than the run
// says, becomes a sentence.
void AddGallery(const RunFolder& run, const RunConfig& config, const RunTables& tables,
                int per_stage, RunObserver* observer, Report* report);

}  // namespace antigrasp
