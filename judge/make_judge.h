#pragma once

#include <functional>
#include <memory>
#include <string>

#include "antigrasp/judge/program_judge.h"
#include "antigrasp/quality/judge.h"
#include "antigrasp/trial/trial_options.h"

namespace antigrasp {

// Objects that are compared are tried at one mass, 50 g: lighter is no harder.
PhysicsTrialOptions AtEqualMass();

struct JudgeOptions {
  MetricOptions metric;
  PhysicsTrialOptions trial = AtEqualMass();  // of the judge `trial`; not its protocol
  ProgramLimits program;
  std::uint64_t seed = 1;
  int threads = 0;
  std::function<void()> tick;  // called now and then during a batch; may throw (Interrupted)
  TypedTrial typed = {};       // goes before `trial` and before what a protocol lays down
};

// Who judges, by name:
//   epsilon         graspability, today's metric (EvaluateGraspability)
//   settled         share of settled grasps that hold, 0 to 1 (JudgeSettled): what follows
//                   trials, at a small part of their cost (docs/metric.md)
//   trial           share of executions held, 0 to 1, by the protocol six-ways (PhysicsTrials);
//                   no score where no grasp is reachable
//   trial:PROTOCOL  by another one, with the friction and mass that it lays down
//   anything else   a program (ProgramJudge)
// InputError for trial:NAME of a protocol that does not exist, without MuJoCo, and for options of a
// trial that were typed for another judge or that this trial makes no use of.
std::unique_ptr<Judge> MakeJudge(const std::string& name, const JudgeOptions& options);

}  // namespace antigrasp
