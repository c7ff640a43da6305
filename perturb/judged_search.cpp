#include "antigrasp/perturb/judged_search.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "antigrasp/perturb/evolution.h"
#include "antigrasp/perturb/hold_descent.h"
#include "antigrasp/perturb/smooth_field.h"

namespace antigrasp {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// How often a candidate is judged: to begin with, and at the end beside the original.
constexpr std::uint64_t kRounds = 2, kLastRounds = 4;
constexpr std::size_t kFinalists = 2;  // of the descents

// A change that keeps the budget; the original's where none of it would do.
struct Candidate {
  SmoothChange change;
  double score = kInfinity;
};

class JudgedRun {
 public:
  JudgedRun(const TriangleMesh& start, const MetricOptions& metric,
            const JudgedSearchOptions& options, Judge* judge, int threads, std::uint64_t seed)
      : start_(start),
        options_(options),
        judge_(*judge),
        threads_(threads),
        seed_(seed),
        descent_(start, metric,
                 {options.budget, options.descent_steps, options.descent_step, options.radius},
                 seed) {}

  Candidate Descend(std::uint64_t which) const { return {descent_.Descend(which)}; }

  // Scores all under the same new draws, `rounds` times; infinite where the judge has no score.
  // Why it has none of the first one; "" when it has.
  std::string JudgeAll(std::vector<Candidate>* candidates, std::uint64_t batch,
                       std::uint64_t rounds) const {
    std::string why;
    for (Candidate& one : *candidates) one.score = 0.0;
    for (std::uint64_t round = 0; round < rounds; ++round) {
      std::vector<JudgedObject> objects;
      const std::uint64_t stream = RngStream(seed_, "judged-draws", batch, round).NextU64();
      for (const Candidate& one : *candidates) {
        objects.push_back({"candidate", &one.change.mesh, stream});
      }
      const std::vector<Verdict> verdicts = judge_.Score(objects);
      for (std::size_t i = 0; i < verdicts.size(); ++i) {
        (*candidates)[i].score += verdicts[i].score.value_or(kInfinity);
      }
      if (!verdicts.front().score) why = verdicts.front().status;
    }
    return why;
  }

  // Evolution from `best`; its last means. `tick` is called after each generation.
  std::vector<Candidate> Evolve(const Candidate& best, const std::function<void()>& tick) const {
    const SmoothField coarse(start_, options_.coarse_radius / 100.0);
    CmaEs evolution(Eigen::VectorXd::Zero(3 * coarse.centres()),
                    options_.spread / options_.budget.hausdorff);
    const auto candidate = [&](const Eigen::VectorXd& numbers) {
      return Candidate{
          descent_.Kept(best.change.moves + coarse.At(numbers.reshaped(coarse.centres(), 3)))};
    };
    std::vector<Candidate> means;
    for (int generation = 0; generation < options_.generations; ++generation) {
      RngStream rng(seed_, "judged-generation", static_cast<std::uint64_t>(generation));
      const Eigen::MatrixXd& samples = evolution.Ask(&rng);
      std::vector<Candidate> candidates(static_cast<std::size_t>(samples.cols()));
      ParallelFor(samples.cols(), threads_, [&](std::int64_t i) {
        candidates[static_cast<std::size_t>(i)] = candidate(samples.col(i));
      });
      JudgeAll(&candidates, static_cast<std::uint64_t>(generation) + 1, 1);
      if (!judge_.Stopped().empty()) break;
      std::vector<double> scores;
      for (const Candidate& one : candidates) scores.push_back(one.score);
      evolution.Tell(scores);
      const int left = options_.generations - 1 - generation;
      if (left == 0 || left == options_.generations / 4) {
        means.push_back(candidate(evolution.mean()));
      }
      tick();
    }
    return means;
  }

 private:
  const TriangleMesh& start_;
  const JudgedSearchOptions& options_;
  Judge& judge_;
  int threads_;
  std::uint64_t seed_;
  HoldDescent descent_;
};

void SortByScore(std::vector<Candidate>* candidates) {
  std::stable_sort(candidates->begin(), candidates->end(),
                   [](const Candidate& a, const Candidate& b) { return a.score < b.score; });
}

}  // namespace

void Bind(OptionTable* table, JudgedSearchOptions* options) {
  JudgedSearchOptions& o = *options;
  Bind(table, &o.budget);
  table->Add("search.starts", &o.starts, 1, 1000,
             "descents from random beginnings; the best is taken");
  table->Add("search.descent_steps", &o.descent_steps, 1, 1e6, "steps of a descent");
  table->Add("search.descent_step", &o.descent_step, 1e-6, 10.0,
             "its first step, percent of the diagonal");
  table->Add("search.radius", &o.radius, 0.0, 100.0,
             "reach of a move over the surface, percent of the diagonal; 0 = by --hausdorff");
  table->Add("search.generations", &o.generations, 0, 1e6,
             "generations of the evolution on the judge, some 15 objects each; 0 = none");
  table->Add("search.coarse_radius", &o.coarse_radius, 1.0, 100.0,
             "reach of a move of the evolution, percent of the diagonal");
  table->Add("search.spread", &o.spread, 1e-6, 10.0,
             "deviation of the first generation, percent of the diagonal");
  table->Add("search.judge_grasps", &o.judge_grasps, 1, 1e6, "grasps a trial plans in the search");
  table->Add("search.judge_draws", &o.judge_draws, 1, 1e4, "how often it executes each");
}

PerturbResult PerturbByJudge(const TriangleMesh& mesh, const MetricOptions& metric,
                             const JudgedSearchOptions& options, Judge* judge, int threads,
                             RngStream* rng, const ProgressFn& progress) {
  PerturbResult result;
  if (!BeginPerturbation(mesh, &result)) return result;
  result.mesh = result.start;
  const JudgedRun run(result.start, metric, options, judge, threads, rng->NextU64());
  // A descent takes about as long as two generations.
  std::int64_t done = 0;
  const std::int64_t total = 2 * options.starts + options.generations + 2;
  const auto advance = [&](std::int64_t work) {
    if (progress) progress(done += work, total);
  };
  std::vector<Candidate> candidates(static_cast<std::size_t>(options.starts));
  ParallelFor(
      options.starts, threads,
      [&](std::int64_t i) {
        candidates[static_cast<std::size_t>(i)] = run.Descend(static_cast<std::uint64_t>(i));
      },
      [&](std::int64_t, std::int64_t) { advance(2); });
  result.iterations = std::int64_t{options.starts} * options.descent_steps;
  run.JudgeAll(&candidates, 0, kRounds);
  SortByScore(&candidates);
  std::vector<Candidate> last = run.Evolve(candidates.front(), [&] { advance(1); });
  candidates.resize(std::min(candidates.size(), kFinalists));
  for (Candidate& one : last) candidates.push_back(std::move(one));
  candidates.insert(candidates.begin(), Candidate{{{}, result.start}});  // which wins a tie
  const std::string why =
      run.JudgeAll(&candidates, static_cast<std::uint64_t>(options.generations) + 1, kLastRounds);
  if (!judge->Stopped().empty()) {
    result.failure = "judge stopped: " + judge->Stopped();
    return result;
  }
  SortByScore(&candidates);
  if (!std::isfinite(candidates.front().score)) {
    result.failure = "no score by the judge: " + why;
    return result;
  }
  result.mesh = candidates.front().change.mesh;
  if (result.mesh.vertices != result.start.vertices) result.moved = result.iterations;
  advance(2);
  return result;
}

}  // namespace antigrasp
