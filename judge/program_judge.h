#pragma once

#include <functional>
#include <memory>
#include <string>

#include "antigrasp/quality/judge.h"
#include "antigrasp/quality/metric_options.h"

namespace antigrasp {

// Who may judge (make_judge.h), for help and messages.
inline constexpr const char* kJudges = "epsilon, settled, trial, trial:PROTOCOL or a program";
// What is wrong with a name that a user gave; empty: nothing.
inline std::string NoJudge(const std::string& name) {
  return name.empty() ? std::string("expected ") + kJudges : std::string();
}

struct ProgramLimits {
  double seconds = 60.0;  // without an answer, then the oldest unanswered object is late
  int restarts = 5;       // how often it is started again
};

// A program of somebody else as judge (docs/judges.md), started once, through the shell. A line of
// JSON an object to its standard input:
//   {"id": 3, "name": "mug", "mesh": "/tmp/antigrasp-judge-x/3-mug.stl", "metres_per_unit": 0.001}
// and one back, in any order within a batch:
//   {"id": 3, "score": 0.61}     lower: harder to grasp; null: it has no score
// The mesh is a binary STL in the object's own unit, which times metres_per_unit is the size that
// the metric looks at; the file is there until the answer.
//
// Statuses of objects without a score: "no score" (null), "not a finite number" (NaN, text, none at
// all), "late", "judge died" (twice with this object as the oldest unanswered), "judge stopped". A
// judge that is silent for a second time limit in a row, or ends, is started again and asked what
// it has not answered; after `restarts` of these it is Stopped(). Lines that answer nothing are
// counted in Notes().
class ProgramJudge : public Judge {
 public:
  // `tick`: called five times a second while it waits; may throw (Interrupted).
  ProgramJudge(std::string command, const MetricOptions& metric, const ProgramLimits& limits,
               std::function<void()> tick = nullptr);
  ~ProgramJudge() override;

  std::string Name() const override { return command_; }
  // InputError when there is no such command.
  std::vector<Verdict> Score(const std::vector<JudgedObject>& objects) override;
  std::string Stopped() const override { return stopped_; }
  std::vector<std::string> Notes() const override;

 protected:
  void TellSettings(const std::function<void(const OptionTable&)>& add) const override;

 private:
  struct Folder;
  struct Talk;
  class Batch;

  std::string command_;
  MetricOptions metric_;
  ProgramLimits limits_;
  std::function<void()> tick_;
  std::unique_ptr<Folder> folder_;  // of the meshes; removed with the judge
  std::unique_ptr<Talk> talk_;
  std::string stopped_;
};

}  // namespace antigrasp
