#pragma once

#include <torch/types.h>

#include <cstdint>
#include <functional>

#include "antigrasp/core/parallel.h"
#include "antigrasp/core/rng.h"
#include "antigrasp/train/elite_niches.h"

namespace antigrasp {

// Judges latents [n, ...]. Row i may be judged with other noise than row j.
using LatentJudge = std::function<JudgedLatents(const torch::Tensor& latents)>;

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
//
// With `niches`, which need the judge's values, elites compete by niche (elite_niches.h), what
// would take a place is judged once more before it does (one more call a trial, of those alone, in
// the places 0 and so on), and every other trial goes along the line to another elite instead, to
// either side of its own, with small moves besides (Vassiliades & Mouret 2018): what lowers the
// score of one often lowers that of others.
torch::Tensor RefineLatents(const torch::Tensor& elites, const LatentTrials& how,
                            const LatentJudge& judge, RngStream* rng,
                            const ProgressFn& progress = nullptr, EliteNiches* niches = nullptr);

}  // namespace antigrasp
