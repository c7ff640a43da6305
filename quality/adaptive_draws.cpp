#include "antigrasp/quality/adaptive_draws.h"

#include <algorithm>
#include <cmath>

#include "antigrasp/core/statistics.h"

namespace antigrasp {
namespace {

// A grasp's own interval is this many standard errors to each side.
constexpr double kStandardErrors = 2.5;
constexpr int kFewestDraws = 5;

void DrawUntil(const GraspModel& model, const MetricOptions& options, int draws,
               NoisyGrasp* noisy) {
  if (noisy->draws >= draws) return;
  std::vector<NoiseDraw> noise(static_cast<std::size_t>(draws - noisy->draws));
  std::vector<double> qualities(noise.size());
  DrawNoises(options, &noisy->noise, noise);
  model.ExecutedQualities(noisy->grasp, noise, qualities);
  for (const double quality : qualities) {
    noisy->sum += quality;
    noisy->sum_of_squares += quality * quality;
  }
  noisy->draws = draws;
}

double Variance(const NoisyGrasp& noisy) {
  const double mean = noisy.Mean();
  return std::max(0.0, noisy.sum_of_squares - noisy.draws * mean * mean) / (noisy.draws - 1);
}

// Half the width of its interval. A few draws that happen to agree say little about the spread: at
// least half of what is usual among the grasps is assumed.
double Uncertainty(const NoisyGrasp& noisy, double usual_variance) {
  const double variance = std::max(Variance(noisy), 0.25 * usual_variance);
  return kStandardErrors * std::sqrt(variance / noisy.draws);
}

double MeanVariance(const std::vector<NoisyGrasp>& grasps) {
  double sum = 0.0;
  for (const NoisyGrasp& noisy : grasps) sum += Variance(noisy);
  return sum / static_cast<double>(grasps.size());
}

}  // namespace

void DrawAll(const GraspModel& model, const MetricOptions& options,
             std::vector<NoisyGrasp>* grasps) {
  for (NoisyGrasp& noisy : *grasps) DrawUntil(model, options, options.num_draws, &noisy);
}

void DrawAdaptively(const GraspModel& model, const MetricOptions& options,
                    std::vector<NoisyGrasp>* grasps) {
  int draws = std::min(options.num_draws, std::max(kFewestDraws, options.num_draws / 5));
  for (NoisyGrasp& noisy : *grasps) DrawUntil(model, options, draws, &noisy);
  std::vector<double> means(grasps->size());
  while (draws < options.num_draws && !grasps->empty()) {
    for (std::size_t i = 0; i < grasps->size(); ++i) means[i] = (*grasps)[i].Mean();
    const Interval target = BootstrapPercentile(means, options.percentile);
    const double usual_variance = MeanVariance(*grasps);
    draws = std::min(2 * draws, options.num_draws);
    for (NoisyGrasp& noisy : *grasps) {
      const double uncertainty = Uncertainty(noisy, usual_variance);
      const bool open =
          noisy.Mean() + uncertainty >= target.low && noisy.Mean() - uncertainty <= target.high;
      if (open) DrawUntil(model, options, draws, &noisy);
    }
  }
}

void Draw(const GraspModel& model, const MetricOptions& options, std::vector<NoisyGrasp>* grasps) {
  if (options.adaptive) {
    DrawAdaptively(model, options, grasps);
  } else {
    DrawAll(model, options, grasps);
  }
}

}  // namespace antigrasp
