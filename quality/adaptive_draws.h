#pragma once

#include <cstdint>
#include <vector>

#include "antigrasp/quality/grasp_model.h"

namespace antigrasp {

// A grasp on its way to a robust quality: the stream of its noise and the sum of what it gave.
struct NoisyGrasp {
  Grasp grasp;
  RngStream noise;
  std::uint64_t candidate = 0;  // which of those tried: the number of the stream
  int draws = 0;
  double sum = 0.0;
  double sum_of_squares = 0.0;

  double Mean() const { return draws > 0 ? sum / draws : 0.0; }
};

// Draws until every grasp has options.num_draws of the model's executed qualities.
void DrawAll(const GraspModel& model, const MetricOptions& options,
             std::vector<NoisyGrasp>* grasps);

// Fewer draws for about the same percentile (successive halving, Karnin et al. 2013, about a
// percentile instead of the best arm): a fifth of the draws for all, then ever more for those alone
// whose own interval still meets the 95 % interval of options.percentile. A grasp that stays in to
// the end has exactly its full quality; the others are decided to lie above or below, and only
// that enters the percentile. The mean over grasps is rougher than with DrawAll.
void DrawAdaptively(const GraspModel& model, const MetricOptions& options,
                    std::vector<NoisyGrasp>* grasps);

// As options.adaptive says.
void Draw(const GraspModel& model, const MetricOptions& options, std::vector<NoisyGrasp>* grasps);

}  // namespace antigrasp
