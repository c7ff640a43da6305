#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "antigrasp/core/word_count.h"
#include "antigrasp/judge/pair_dataset.h"
#include "antigrasp/judge/pair_tables.h"

namespace antigrasp {

// What somebody must know before they train on a set of pairs, by the headings of Gebru et al.,
// "Datasheets for Datasets", CACM 2021, as far as a program can answer them.
class Datasheet {
 public:
  Datasheet(const PairRequest& request, const MetricOptions& metric,
            const MetricOptions& trial_metric, const PhysicsTrialOptions& trial);
  void Add(const LabelledObject& before, const LabelledObject& after);

  int pairs() const { return static_cast<int>(graspability_[0].size()); }
  std::string Text() const;
  std::string Summary() const;  // for people, some lines
  // "no pair to train on (split train) among 2": a sentence for each split that has a share of the
  // objects and none of the pairs.
  std::vector<std::string> EmptySplits() const;

 private:
  std::string Means() const;
  std::string Missing() const;

  PairRequest request_;
  MetricOptions metric_, trial_metric_;
  PhysicsTrialOptions trial_;
  WordCount splits_, left_out_;
  std::array<WordCount, 2> without_share_;  // before, after: pairs whose trial says nothing
  std::array<std::vector<double>, 2> graspability_, held_;  // before, after; by pair
  std::array<std::int64_t, 2> grasps_{}, executions_{};
};

}  // namespace antigrasp
