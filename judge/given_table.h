#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "antigrasp/core/csv_writer.h"
#include "antigrasp/core/word_count.h"
#include "antigrasp/quality/given_grasps.h"

namespace antigrasp {

class Passer;

// What a trial says of one given grasp.
struct TriedGrasp {
  std::string status;      // "ok", or why it was not tried
  std::int64_t pose = -1;  // the stable pose that the object stood in; -1: none
  int executions = 0;
  int held = 0;  // of these
};

void PassFields(Passer& pass, TriedGrasp& tried);

// Given grasps as `evaluate --grasps-in` writes them (docs/formats.md), object by object.
class GivenTable {
 public:
  explicit GivenTable(bool in_physics);
  // `scores`: one a grasp; none: the object is not usable for this reason. `tried`: as many in
  // physics.
  void Add(const std::string& object, const std::string& status,
           const std::vector<GivenGrasp>& grasps, const std::vector<GivenScore>& scores,
           const std::vector<TriedGrasp>& tried);
  // What was added since the last call, the header first.
  std::string TakeText() { return csv_.TakeText(); }

  // How many of which status, their mean, what was held.
  std::vector<std::string> Summary() const;
  bool any_scored() const { return scored_ > 0; }
  bool all_miss() const { return scored_ > 0 && statuses_.Of("misses") == scored_; }

 private:
  void AddScore(const GivenScore& score);
  void AddTrial(const TriedGrasp& tried);

  bool in_physics_;
  CsvWriter csv_;
  WordCount statuses_, trials_;
  int objects_ = 0, scored_ = 0, positive_ = 0, asked_ = 0, reached_ = 0;
  int executions_ = 0, held_ = 0;
  double quality_ = 0.0;
};

}  // namespace antigrasp
