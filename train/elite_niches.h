#pragma once

#include <torch/types.h>

#include <cstdint>
#include <vector>

#include "antigrasp/core/rng.h"

namespace antigrasp {

// What a judge says of latents. Scores: lower = better, NaN = not to be had.
struct JudgedLatents {
  JudgedLatents(std::vector<double> scores, torch::Tensor values = {});
  std::vector<double> scores;
  torch::Tensor values;  // network values [n, ...] of what they draw; undefined: not asked for
};

// Elites that trials change, held apart by niches, as in MAP-Elites (Mouret & Clune 2015) with the
// niches of Vassiliades et al. (2018): a niche is what is nearer to one of some shapes of the prior
// set than to the others, by network values, and holds as many elites as its share of the prior
// set. Trials alone would take all elites to where a set's least graspable shapes are. A trial
//   - that falls into its parent's niche takes its parent's place if it scores lower;
//   - into a niche with room, the place of its parent where that one's niche has too many, else
//     that of the highest score among all niches that have too many, whatever it scores itself up
//     to a limit, beyond it only if it scores lower;
//   - into a full niche, the place of the highest score there if it scores lower;
// but nowhere if it would lie nearer to another elite than near-duplicates are apart.
class EliteNiches {
 public:
  // prior: network values [N, ...], N >= 2; `niches` of its shapes, at least 1, are drawn from
  // `rng`, all if it has fewer. elites: how many there are. admits: the limit above, as a
  // percentile of the scores of the elites as they are then; at 100 there is none.
  EliteNiches(const torch::Tensor& prior, std::int64_t elites, std::int64_t niches, RngStream rng,
              double admits);

  // The elites as they are; elite i is row i.
  void Set(const JudgedLatents& elites);

  // What elites score under other noise: the mean of all that was said of an elite counts.
  void JudgeAgain(const std::vector<double>& scores);

  // The trials that could take a place by their scores, ascending. Worth a second look: of
  // hundreds that hardly differ some score low by chance, and these would be the ones that are
  // kept.
  std::vector<std::int64_t> Promising(const JudgedLatents& trials) const;

  // For every elite the trial that takes its place, or -1; trial i is a change of elite i, and its
  // parent is what has that place by then. Two products of [elites, r^3] and its transpose, and two
  // matrices [elites, elites] of float.
  std::vector<std::int64_t> Take(const JudgedLatents& trials);

  std::int64_t Filled() const;  // niches that hold an elite

 private:
  struct Place {
    std::int64_t elite;  // -1: none
    bool at_any_score;
  };
  double Limit() const;
  Place PlaceOf(std::int64_t trial, std::size_t niche) const;
  bool Takes(double score, const Place& place, double limit) const;
  bool HasTooMany(std::int64_t elite) const;
  bool Higher(std::int64_t a, std::int64_t b) const;  // NaN is highest

  torch::Tensor centres_;               // [niches, r^3] float32
  std::vector<std::int64_t> capacity_;  // of each niche; their sum is the number of elites
  std::vector<std::int64_t> count_;     // of each niche
  double apart_ = 0.0, admits_ = 100.0;
  std::vector<double> score_;       // of each elite, a mean
  std::vector<int> judged_;         // how often that was, of each elite
  std::vector<std::size_t> niche_;  // of each elite
  torch::Tensor values_;            // of the elites, [elites, r^3] float32
};

}  // namespace antigrasp
