#pragma once

#include <torch/types.h>

#include <cstdint>
#include <functional>
#include <vector>

#include "antigrasp/core/parallel.h"
#include "antigrasp/core/rng.h"

namespace antigrasp {

// Scores of latents [n, ...], lower = better, NaN = not to be had. Row i may be judged with other
// noise than row j.
using LatentJudge = std::function<std::vector<double>(const torch::Tensor& latents)>;

struct LatentTrials {
  int trials = 0;
  std::int64_t first = 0;  // columns from here on are moved: the numbers of the parts
  double step = 0.3;       // deviation of a move, in every number that it moves
};

// Every elite [n, first + numbers] by an evolution strategy of its own, (1+1) (Rechenberg 1973): a
// trial moves two fifths of its numbers, or every other time a seventh, and is kept where the judge
// scores it lower. Every fourth trial the elites are judged again, each in the place of another,
// with that place's noise: what is kept would else be what the noise was kind to. Calls the judge
// 1.25 times a trial, with n latents; draws from `rng` depend on n and trials only.
torch::Tensor RefineLatents(const torch::Tensor& elites, const LatentTrials& how,
                            const LatentJudge& judge, RngStream* rng,
                            const ProgressFn& progress = nullptr);

}  // namespace antigrasp
