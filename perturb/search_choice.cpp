#include "antigrasp/perturb/search_choice.h"

#include <algorithm>
#include <memory>

#include "antigrasp/core/error.h"
#include "antigrasp/judge/make_judge.h"

namespace antigrasp {
namespace {

constexpr const char* kEpsilonObjective = "epsilon";

bool OnTheMetric(const SearchChoice& choice) { return choice.objective == kEpsilonObjective; }

void BindObjective(OptionTable* table, SearchChoice* choice) {
  table->Add("search.objective", &choice->objective, {},
             "what is minimised: epsilon, the metric, by a descent; or what a judge says: "
             "settled, trial, trial:PROTOCOL or a program (docs/judges.md)");
}

// A few executions an object are enough: evolution averages over its generations.
JudgeOptions InTheSearch(const SearchChoice& choice, JudgeOptions options) {
  options.trial.draws = choice.judged.judge_draws;
  if (choice.objective == "trial:paper") {
    options.trial.series.series = std::max(1, choice.judged.judge_grasps / 5);
  } else {
    options.metric.num_grasps = choice.judged.judge_grasps;
    options.metric.num_draws = 1;
  }
  return options;
}

}  // namespace

void Bind(OptionTable* table, SearchChoice* choice) {
  BindObjective(table, choice);
  Bind(table, &choice->descent);
  Bind(table, &choice->judged);
}

void BindUsed(OptionTable* table, SearchChoice* choice) {
  if (OnTheMetric(*choice)) return Bind(table, &choice->descent);
  BindObjective(table, choice);
  Bind(table, &choice->judged);
}

void RequireUsed(const SearchChoice& choice,
                 const std::function<std::string(const std::string& key)>& typed) {
  SearchChoice copy = choice;
  OptionTable all, used;
  Bind(&all, &copy);
  BindUsed(&used, &copy);
  for (const Option& option : all.options()) {
    const bool known = std::any_of(used.options().begin(), used.options().end(),
                                   [&](const Option& other) { return other.key == option.key; });
    const std::string text = typed(option.key);
    if (known || text.empty() || option.key == "search.objective") continue;
    throw InputError(
        "the search on " + choice.objective + " has no such thing", text,
        OnTheMetric(choice) ? "--objective settled, or another judge" : "--objective epsilon");
  }
}

void UseSearch(const SearchChoice& choice, int threads, PerturbSettings* settings,
               const JudgePool::Maker& make) {
  const MetricOptions metric = settings->metric;
  if (OnTheMetric(choice)) {
    settings->method = [metric, options = choice.descent](
                           const TriangleMesh& mesh, const PairLimits&, const PerturbOptions&,
                           RngStream* rng, const ProgressFn& progress) {
      return PerturbBySearch(mesh, metric, options, rng, progress);
    };
    return;
  }
  JudgeOptions judging;
  judging.metric = metric;
  judging.seed = settings->seed;
  judging.threads = threads;
  const auto pool = [&make, name = choice.objective](const JudgeOptions& options) {
    const auto judges = std::make_shared<JudgePool>(
        make ? make : JudgePool::Maker([name, options] { return MakeJudge(name, options); }));
    JudgePool::Lease probe(judges.get());  // refused before the work
    return judges;
  };
  settings->judges = pool(judging);
  settings->method = [metric, options = choice.judged, threads,
                      judges = pool(InTheSearch(choice, judging))](
                         const TriangleMesh& mesh, const PairLimits&, const PerturbOptions&,
                         RngStream* rng, const ProgressFn& progress) {
    const JudgePool::Lease judge(judges.get());
    return PerturbByJudge(mesh, metric, options, judge.get(), threads, rng, progress);
  };
}

}  // namespace antigrasp
