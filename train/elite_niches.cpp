#include "antigrasp/train/elite_niches.h"

#include <torch/utils.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "antigrasp/core/check.h"
#include "antigrasp/core/statistics.h"
#include "antigrasp/train/elites.h"
#include "antigrasp/train/prior_similarity.h"
#include "antigrasp/train/prior_spread.h"

namespace antigrasp {
namespace {

// Near-duplicates are nearer than half of the median distance to the nearest neighbour
// (prior_similarity.h); samples that are drawn around elites come a little nearer.
constexpr double kApart = 0.55;

torch::Tensor RowsOf(const torch::Tensor& values) { return values.flatten(1).to(torch::kFloat); }

}  // namespace

JudgedLatents::JudgedLatents(std::vector<double> judged, torch::Tensor drawn)
    : scores(std::move(judged)), values(std::move(drawn)) {}

EliteNiches::EliteNiches(const torch::Tensor& prior, std::int64_t elites, std::int64_t niches,
                         RngStream rng, double admits)
    : admits_(admits) {
  const torch::NoGradGuard no_grad;
  const std::int64_t shapes = prior.size(0);
  AG_CHECK(elites > 0 && niches > 0, "elites, and niches for them");
  const std::vector<double> order =
      RandomOrder(std::vector<double>(static_cast<std::size_t>(shapes)), &rng);
  const std::vector<std::int64_t> chosen = LeastGraspable(order, niches);
  centres_ = RowsOf(prior.index_select(0, torch::tensor(chosen, torch::kLong)));
  std::vector<double> residents(chosen.size(), 0.0);
  for (const std::int64_t niche : NearestRows(prior, centres_)) {
    ++residents[static_cast<std::size_t>(niche)];
  }
  capacity_ = SharesOf(residents, elites);
  // As many shapes as there are elites: of two sets of one size near-duplicates are counted.
  apart_ = kApart * PriorSpread(prior.slice(0, 0, std::max<std::int64_t>(2, elites)), 50).limit();
}

void EliteNiches::Set(const JudgedLatents& elites) {
  score_ = elites.scores;
  judged_.assign(score_.size(), 1);
  values_ = RowsOf(elites.values).clone();
  AG_CHECK(values_.size(0) == std::ssize(score_), "values of every elite");
  niche_.clear();
  count_.assign(capacity_.size(), 0);
  for (const std::int64_t niche : NearestRows(values_, centres_)) {
    niche_.push_back(static_cast<std::size_t>(niche));
    ++count_[niche_.back()];
  }
}

void EliteNiches::JudgeAgain(const std::vector<double>& scores) {
  AG_CHECK(scores.size() == score_.size(), "a score for every elite");
  for (std::size_t i = 0; i < scores.size(); ++i) {
    if (std::isnan(scores[i])) continue;
    const bool first = std::isnan(score_[i]);
    judged_[i] = first ? 1 : judged_[i] + 1;
    score_[i] = first ? scores[i] : score_[i] + (scores[i] - score_[i]) / judged_[i];
  }
}

std::int64_t EliteNiches::Filled() const {
  return std::count_if(count_.begin(), count_.end(), [](std::int64_t n) { return n > 0; });
}

// What comes where there is room has not been refined there. Without a limit the last of it is what
// an episode ends with: of bottles a twentieth, which scores as shapes of the prior set do.
double EliteNiches::Limit() const {
  std::vector<double> known;
  for (const double score : score_) {
    if (!std::isnan(score)) known.push_back(score);
  }
  if (admits_ >= 100.0 || known.empty()) return std::numeric_limits<double>::infinity();
  return DiscretePercentile(std::move(known), admits_);
}

bool EliteNiches::HasTooMany(std::int64_t elite) const {
  const std::size_t niche = niche_[static_cast<std::size_t>(elite)];
  return count_[niche] > capacity_[niche];
}

bool EliteNiches::Higher(std::int64_t a, std::int64_t b) const {
  const double of_a = score_[static_cast<std::size_t>(a)];
  const double of_b = score_[static_cast<std::size_t>(b)];
  return std::isnan(of_b) ? false : std::isnan(of_a) || of_a > of_b;
}

EliteNiches::Place EliteNiches::PlaceOf(std::int64_t trial, std::size_t niche) const {
  if (niche == niche_[static_cast<std::size_t>(trial)]) return {trial, false};
  const bool room = count_[niche] < capacity_[niche];
  if (room && HasTooMany(trial)) return {trial, true};
  Place place{-1, room};
  for (std::int64_t i = 0; i < std::ssize(niche_); ++i) {
    if (room ? !HasTooMany(i) : niche_[static_cast<std::size_t>(i)] != niche) continue;
    if (place.elite < 0 || Higher(i, place.elite)) place.elite = i;
  }
  return place;
}

bool EliteNiches::Takes(double score, const Place& place, double limit) const {
  if (std::isnan(score) || place.elite < 0) return false;
  const double there = score_[static_cast<std::size_t>(place.elite)];
  return (place.at_any_score && score <= limit) || std::isnan(there) || score < there;
}

std::vector<std::int64_t> EliteNiches::Promising(const JudgedLatents& trials) const {
  const std::vector<std::int64_t> niches = NearestRows(trials.values, centres_);
  const double limit = Limit();
  std::vector<std::int64_t> promising;
  for (std::int64_t i = 0; i < std::ssize(niches); ++i) {
    const auto slot = static_cast<std::size_t>(i);
    const Place place = PlaceOf(i, static_cast<std::size_t>(niches[slot]));
    if (Takes(trials.scores[slot], place, limit)) promising.push_back(i);
  }
  return promising;
}

std::vector<std::int64_t> EliteNiches::Take(const JudgedLatents& trials) {
  const torch::NoGradGuard no_grad;
  const torch::Tensor values = RowsOf(trials.values);
  const std::int64_t count = values.size(0);
  AG_CHECK(count == std::ssize(score_) && count == std::ssize(trials.scores), "a trial an elite");
  const std::vector<std::int64_t> niches = NearestRows(values, centres_);
  const DistanceMatrix to_trials = ValueDistances(values, values);
  DistanceMatrix to_elites = ValueDistances(values, values_);
  const auto near_another = [&](std::int64_t trial, std::int64_t place) {
    for (std::int64_t i = 0; i < count; ++i) {
      if (i != place && to_elites(trial, i) < apart_) return true;
    }
    return false;
  };
  const double limit = Limit();
  std::vector<std::int64_t> takes(score_.size(), -1);
  for (std::int64_t i = 0; i < count; ++i) {
    const double score = trials.scores[static_cast<std::size_t>(i)];
    const auto niche = static_cast<std::size_t>(niches[static_cast<std::size_t>(i)]);
    const Place place = PlaceOf(i, niche);
    if (!Takes(score, place, limit) || near_another(i, place.elite)) continue;
    const auto slot = static_cast<std::size_t>(place.elite);
    takes[slot] = i;
    score_[slot] = score;
    judged_[slot] = 1;
    --count_[niche_[slot]];
    niche_[slot] = niche;
    ++count_[niche];
    values_[place.elite].copy_(values[i]);
    to_elites.col(place.elite) = to_trials.col(i);
  }
  return takes;
}

}  // namespace antigrasp
