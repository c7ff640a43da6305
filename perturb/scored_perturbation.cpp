#include "antigrasp/perturb/scored_perturbation.h"

#include <chrono>
#include <cmath>
#include <limits>

#include "antigrasp/core/check.h"
#include "antigrasp/mesh/place.h"

namespace antigrasp {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

double ValueOf(const Graspability& score) {
  return score.status == GraspabilityStatus::kNotEvaluable ? kNaN : score.value;
}

// Nothing moved, and no wonder: that says nothing about the algorithm, and its difference of 0 does
// not belong into a mean. A fine mesh that did not move does.
std::string WhyNothingMoved(const PerturbResult& result) {
  if (result.moved > 0 || result.iterations == 0 || result.no_pairs_left) return "";
  if (!IsCoarse(result.start)) return "";
  return "unchanged: too few vertices: " + std::to_string(result.start.vertices.size());
}

// Under the draws of the object's own stream, which no search on this judge has seen.
void JudgeBoth(std::uint64_t object, JudgePool* judges, ScoredPerturbation* out) {
  const JudgePool::Lease judge(judges);
  const std::vector<Verdict> verdicts =
      judge->Score({{"before", &out->before, object}, {"after", &out->result.mesh, object}});
  out->judge = judge->Name();
  out->judge_before = verdicts[0].score.value_or(kNaN);
  out->judge_after = verdicts[1].score.value_or(kNaN);
}

// Of an object that lies about the origin.
ScoredPerturbation AboutTheOrigin(const TriangleMesh& given, const PerturbSettings& settings,
                                  std::uint64_t object, const ProgressFn& progress) {
  using Clock = std::chrono::steady_clock;
  ScoredPerturbation out;
  out.graspability_before = out.graspability_after = kNaN;
  out.judge_before = out.judge_after = kNaN;
  out.normals = {kNaN, kNaN};
  out.change = {kNaN, kNaN, kNaN, kNaN};
  out.result.failure = WhyNotPrintable(given);
  if (!out.result.failure.empty()) {
    out.result.failure = "before: " + out.result.failure;
    return out;
  }
  const TriangleMesh mesh = Subdivided(given, settings.subdivide);
  out.before = InSinglePrecision(mesh);
  const Graspability before =
      EvaluateGraspability(out.before, settings.metric, settings.seed, object);
  out.graspability_before = ValueOf(before);
  const PairLimits pairs = PairLimitsOf(settings.common, settings.metric.friction, before.scale);
  RngStream rng(settings.seed, "perturb", object);
  const auto start = Clock::now();
  out.result = settings.method(mesh, pairs, settings.common, &rng, progress);
  out.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  out.pairs_before = CountAntipodalPairs(out.before, pairs);
  if (out.result.failure.empty()) out.result.failure = WhyNothingMoved(out.result);
  if (out.result.mesh.faces.empty()) return out;
  out.pairs_after = CountAntipodalPairs(out.result.mesh, pairs);
  out.graspability_after =
      ValueOf(EvaluateGraspability(out.result.mesh, settings.metric, settings.seed, object));
  if (settings.judges && out.result.failure.empty()) {
    JudgeBoth(object, settings.judges.get(), &out);
  }
  out.normals = CompareNormals(out.result.start, out.result.mesh);
  out.change = CompareMeshes(out.before, out.result.mesh);
  return out;
}

}  // namespace

ScoredPerturbation PerturbAndScore(const TriangleMesh& mesh, const PerturbSettings& settings,
                                   std::uint64_t object, const ProgressFn& progress) {
  const Eigen::Vector3d place = RoundPlace(mesh);
  if (place.isZero(0.0)) return AboutTheOrigin(mesh, settings, object, progress);
  ScoredPerturbation out =
      AboutTheOrigin(Transformed(mesh, 1.0, -place), settings, object, progress);
  for (TriangleMesh* moved : {&out.before, &out.result.start, &out.result.mesh}) {
    *moved = Transformed(*moved, 1.0, place);
  }
  return out;
}

MeanInterval KappaReduction(const std::vector<double>& before, const std::vector<double>& after) {
  AG_CHECK(before.size() == after.size(), "pairs");
  std::vector<double> first, second;
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (std::isnan(before[i]) || std::isnan(after[i])) continue;
    first.push_back(before[i]);
    second.push_back(after[i]);
  }
  const double mean_before = MeanWithInterval(first).mean;
  const double ratio = MeanWithInterval(second).mean / mean_before;
  // The ratio's deviation is, to first order, the mean of these residuals.
  std::vector<double> residuals;
  for (std::size_t i = 0; i < first.size(); ++i) {
    residuals.push_back(100.0 * (second[i] - ratio * first[i]) / mean_before);
  }
  const MeanInterval of_residuals = MeanWithInterval(residuals);
  return {100.0 * (1.0 - ratio), of_residuals.half_width, of_residuals.count};
}

}  // namespace antigrasp
