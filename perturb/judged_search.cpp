#include "antigrasp/perturb/judged_search.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "antigrasp/perturb/evolution.h"
#include "antigrasp/perturb/search_objective.h"
#include "antigrasp/perturb/smooth_field.h"
#include "antigrasp/perturb/validity.h"
#include "antigrasp/quality/object_size.h"

namespace antigrasp {
namespace {

using Eigen::MatrixX3d;
using Eigen::Vector3d;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Adam (Kingma and Ba 2015), as in search.cpp; the last step is a tenth of the first.
constexpr double kMomentum = 0.9, kSpreadMomentum = 0.97, kLeastSpread = 0.3, kLastStep = 0.1;
constexpr double kStartNoise = 0.5;  // of the vectors to begin with, percent of the diagonal
constexpr int kDescentDraws = 10, kNoisePool = 4000;
// How often a candidate is judged: to begin with, and at the end beside the original.
constexpr std::uint64_t kRounds = 2, kLastRounds = 4;
constexpr std::size_t kFinalists = 2;  // of the descents
// A change that breaks the budget is tried again as this share of itself.
constexpr double kShares[] = {1.0, 0.95, 0.9, 0.8, 0.7, 0.6, 0.5, 0.4, 0.3, 0.2, 0.1};

// A change that keeps the budget, with the moves that it is made of.
struct Candidate {
  MatrixX3d moves;    // about: where a share was taken, that share of them
  TriangleMesh mesh;  // single precision; the original's when no share of the moves would do
  double score = kInfinity;
};

class JudgedRun {
 public:
  JudgedRun(const TriangleMesh& start, const MetricOptions& metric,
            const JudgedSearchOptions& options, Judge* judge, int threads, std::uint64_t seed)
      : start_(start),
        metric_(metric),
        options_(options),
        judge_(*judge),
        threads_(threads),
        seed_(seed),
        keeper_(start, options.budget),
        field_(start, FieldRadius(options) / 100.0) {
    objective_.draws = kDescentDraws;
    RngStream noise(seed, "judged-noise");
    for (int i = 0; i < kNoisePool; ++i) pool_.push_back(DrawNoise(metric, &noise));
  }

  // One descent on the share that holds.
  Candidate Descend(std::uint64_t which) const {
    RngStream rng(seed_, "judged-start", which);
    MatrixX3d vectors(field_.centres(), 3);
    for (double& x : vectors.reshaped()) x = kStartNoise / options_.budget.hausdorff * rng.Normal();
    MatrixX3d mean = MatrixX3d::Zero(field_.centres(), 3), square = mean;
    for (int step = 0; step < options_.descent_steps; ++step) {
      const MatrixX3d slope = Slope(field_.At(vectors), which, static_cast<std::uint64_t>(step));
      mean = kMomentum * mean + (1.0 - kMomentum) * slope;
      square = kSpreadMomentum * square + (1.0 - kSpreadMomentum) * slope.cwiseAbs2();
      const MatrixX3d spread = (square / (1.0 - std::pow(kSpreadMomentum, step + 1))).cwiseSqrt();
      const double least = kLeastSpread * spread.mean();
      if (!(least > 0.0)) continue;  // no grasp is left
      const double length = options_.descent_step / options_.budget.hausdorff /
                            (1.0 - std::pow(kMomentum, step + 1)) *
                            std::pow(kLastStep, double(step) / options_.descent_steps);
      vectors -= length * (mean.array() / (spread.array() + least)).matrix();
    }
    return Kept(field_.At(vectors));
  }

  // The whole change, or as much of it as keeps the budget.
  Candidate Kept(const MatrixX3d& moves) const {
    for (const double share : kShares) {
      TriangleMesh mesh = InSinglePrecision(MovedBy(moves, keeper_.longest_move(), share, start_));
      if (keeper_.Broken(mesh).empty()) return {share * moves, std::move(mesh)};
    }
    return {0.0 * moves, start_};
  }

  // Scores all under the same new draws, `rounds` times; infinite where the judge has no score.
  void JudgeAll(std::vector<Candidate>* candidates, std::uint64_t batch,
                std::uint64_t rounds) const {
    for (Candidate& one : *candidates) one.score = 0.0;
    for (std::uint64_t round = 0; round < rounds; ++round) {
      std::vector<JudgedObject> objects;
      const std::uint64_t stream = RngStream(seed_, "judged-draws", batch, round).NextU64();
      for (const Candidate& one : *candidates) objects.push_back({"candidate", &one.mesh, stream});
      const std::vector<Verdict> verdicts = judge_.Score(objects);
      for (std::size_t i = 0; i < verdicts.size(); ++i) {
        (*candidates)[i].score += verdicts[i].score.value_or(kInfinity);
      }
    }
  }

  // Evolution from `best`; its last means. `tick` is called after each generation.
  std::vector<Candidate> Evolve(const Candidate& best, const std::function<void()>& tick) const {
    const SmoothField coarse(start_, options_.coarse_radius / 100.0);
    CmaEs evolution(Eigen::VectorXd::Zero(3 * coarse.centres()),
                    options_.spread / options_.budget.hausdorff);
    const auto candidate = [&](const Eigen::VectorXd& numbers) {
      return Kept(best.moves + coarse.At(numbers.reshaped(coarse.centres(), 3)));
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
  // Of the objective by the field's vectors.
  MatrixX3d Slope(const MatrixX3d& moves, std::uint64_t start, std::uint64_t step) const {
    const TriangleMesh mesh = MovedBy(moves, keeper_.longest_move(), 1.0, start_);
    const double scale = MetresPerUnit(metric_, Bounds(mesh).Extent());
    const TriangleMesh metres = Transformed(mesh, scale, Vector3d::Zero());
    const std::vector<Vector3d> normals = FaceNormals(mesh);
    const std::uint64_t seed = RngStream(seed_, "judged-grasps", start).NextU64();
    MeanHold hold =
        EvaluateMeanHold(SampleAttackGrasps(metres, metric_, objective_, pool_, seed, step),
                         normals, metric_, objective_);
    std::vector<Vector3d> by_vertex(mesh.vertices.size(), Vector3d::Zero());
    keeper_.AddPenalty(mesh, normals, &hold.by_normal, &by_vertex);
    const std::vector<Vector3d> by_turn = DerivativeByVertices(mesh, hold.by_normal);
    for (std::size_t v = 0; v < by_vertex.size(); ++v) by_vertex[v] += by_turn[v];
    return field_.Back(ByMoves(moves, keeper_.longest_move(), by_vertex));
  }

  const TriangleMesh& start_;
  const MetricOptions& metric_;
  const JudgedSearchOptions& options_;
  Judge& judge_;
  int threads_;
  std::uint64_t seed_;
  BudgetKeeper keeper_;
  SmoothField field_;
  ObjectiveOptions objective_;
  std::vector<NoiseDraw> pool_;
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

double FieldRadius(const JudgedSearchOptions& options) {
  return options.radius > 0.0 ? options.radius
                              : std::clamp(5.0 + 1.4 * options.budget.hausdorff, 6.0, 12.0);
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
  candidates.insert(candidates.begin(), Candidate{{}, result.start});  // which wins a tie
  run.JudgeAll(&candidates, static_cast<std::uint64_t>(options.generations) + 1, kLastRounds);
  if (!judge->Stopped().empty()) {
    result.failure = "judge stopped: " + judge->Stopped();
    return result;
  }
  SortByScore(&candidates);
  if (std::isfinite(candidates.front().score)) result.mesh = candidates.front().mesh;
  if (result.mesh.vertices != result.start.vertices) result.moved = result.iterations;
  advance(2);
  return result;
}

}  // namespace antigrasp
