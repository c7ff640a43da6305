#pragma once

#include "antigrasp/core/observer.h"
#include "antigrasp/report/page/report.h"
#include "antigrasp/train/make_gan.h"
#include "antigrasp/train/run_record.h"

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

// Adds the gallery to the report, of whose run the stages are: of every one that can be made again
// a group and its objects, with the grasps that the run evaluated. What cannot be made, or scores
// otherwise than the run says, becomes a sentence. `config`: the run's, with the threads to use;
// `make`: the shape model that it was started with.
void AddGallery(const RunRecord& run, const RunConfig& config, int per_stage,
                const ShapeModelMaker& make, RunObserver* observer, Report* report);

}  // namespace antigrasp
