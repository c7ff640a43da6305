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
  void TellSettings(const std::function<void(const OptionTable&)>& add) const override {
    MetricOptions metric = options_.metric;
    OptionTable table;
    Bind(&table, &metric);
    add(table);
  }
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
    return summary.HasShare() ? Verdict::Of(summary.held.front().value)
                              : Verdict::None(summary.status);
  }
  void TellSettings(const std::function<void(const OptionTable&)>& add) const override {
    MetricOptions metric = options_.metric;
    PhysicsTrialOptions trial = options_.trial;
    std::string engine = "mujoco " + MujocoVersion();
    OptionTable table;
    table.Add("engine", &engine, {}, "of the physics");
    Bind(&table, &metric);
    Bind(&table, &trial);
    add(table);
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
  const bool by_trial = name == kTrial || name.starts_with(std::string(kTrial) + ":");
  if (!by_trial && !options.typed.First().empty()) {
    throw InputError("judge " + name + " has no such thing", options.typed.First(),
                     "--judge trial or trial:PROTOCOL");
  }
  if (name == kEpsilon) return std::make_unique<MetricJudge>(name, options);
  if (name == kSettled) {
    JudgeOptions settled = options;
    JudgeSettled(&settled.metric);
    return std::make_unique<MetricJudge>(name, settled);
  }
  if (!by_trial) {
    return std::make_unique<ProgramJudge>(name, options.metric, options.program, options.tick);
  }
  const ProtocolName protocol = ProtocolNamed(name);
  JudgeOptions of_trial = options;
  of_trial.trial =
      TrialOptionsOf(ProtocolOf(protocol), options.typed, &of_trial.metric, options.trial);
  RequireOptionsUsed(ProtocolOf(protocol), of_trial.trial.physics.tip.shape, options.typed);
  PhysicsTrials(of_trial.metric, of_trial.trial, options.seed, 1);  // refuses what cannot be
  return std::make_unique<TrialOfJudge>("trial:" + ChoiceName(protocol), of_trial);
}

}  // namespace antigrasp
