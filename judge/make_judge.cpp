#include "antigrasp/judge/make_judge.h"

#include "antigrasp/core/choice.h"
#include "antigrasp/core/error.h"
#include "antigrasp/core/parallel.h"
#include "antigrasp/quality/graspability.h"
#include "antigrasp/trial/trial_summary.h"

namespace antigrasp {
namespace {

constexpr const char* kEpsilon = "epsilon";
constexpr const char* kSettled = "settled";
constexpr std::string_view kTrial = "trial";

// Judges that need nothing but the object: side by side.
class ObjectJudge : public Judge {
 public:
  ObjectJudge(std::string name, JudgeOptions options)
      : options_(std::move(options)), name_(std::move(name)) {}
  std::string Name() const override { return name_; }
  std::vector<Verdict> Score(const std::vector<JudgedObject>& objects) override {
    std::vector<Verdict> verdicts(objects.size());
    ParallelFor(
        std::ssize(objects), options_.threads,
        [&](std::int64_t i) {
          verdicts[static_cast<std::size_t>(i)] = ScoreOne(objects[static_cast<std::size_t>(i)]);
        },
        [this](std::int64_t, std::int64_t) {
          if (options_.tick) options_.tick();
        });
    return verdicts;
  }

 protected:
  virtual Verdict ScoreOne(const JudgedObject& object) const = 0;
  JudgeOptions options_;

 private:
  std::string name_;
};

// The metric, whichever its constants make of it.
class MetricJudge final : public ObjectJudge {
 public:
  using ObjectJudge::ObjectJudge;

 private:
  Verdict ScoreOne(const JudgedObject& object) const override {
    const Graspability score =
        EvaluateGraspability(*object.mesh, options_.metric, options_.seed, object.stream);
    if (score.status == GraspabilityStatus::kNotEvaluable) {
      return Verdict::None(std::string(antigrasp::Name(score.status)));
    }
    return Verdict::Of(score.value);
  }
};

class TrialOfJudge final : public ObjectJudge {
 public:
  using ObjectJudge::ObjectJudge;

 private:
  Verdict ScoreOne(const JudgedObject& object) const override {
    PhysicsTrials trials(options_.metric, options_.trial, options_.seed, 1);
    const TrialSummary summary =
        SummaryOf(object.name, trials.Try(*object.mesh, object.stream), trials.protocol());
    if (summary.poses == 0 && trials.protocol().table) return Verdict::None(summary.status);
    return Verdict::Of(summary.held.front().value);
  }
};

ProtocolName ProtocolNamed(const std::string& judge) {
  if (judge == kTrial) return ProtocolName::kSixWays;
  const std::string name = judge.substr(kTrial.size() + 1);
  const auto found = FindChoice<ProtocolName>(name);
  if (found) return *found;
  throw InputError("no protocol " + name, "judge " + judge,
                   Alternatives(ChoiceNames<ProtocolName>()));
}

}  // namespace

PhysicsTrialOptions AtEqualMass() {
  PhysicsTrialOptions options;
  options.mass = 0.05;
  return options;
}

std::unique_ptr<Judge> MakeJudge(const std::string& name, const JudgeOptions& options) {
  if (name == kEpsilon) return std::make_unique<MetricJudge>(name, options);
  if (name == kSettled) {
    JudgeOptions settled = options;
    JudgeSettled(&settled.metric);
    return std::make_unique<MetricJudge>(name, settled);
  }
  if (name != kTrial && !name.starts_with(std::string(kTrial) + ":")) {
    return std::make_unique<ProgramJudge>(name, options.metric, options.program, options.tick);
  }
  const ProtocolName protocol = ProtocolNamed(name);
  JudgeOptions of_trial = options;
  ApplyProtocol(ProtocolOf(protocol), &of_trial.metric, &of_trial.trial);
  PhysicsTrials(of_trial.metric, of_trial.trial, options.seed, 1);  // refuses what cannot be
  return std::make_unique<TrialOfJudge>("trial:" + ChoiceName(protocol), of_trial);
}

}  // namespace antigrasp
