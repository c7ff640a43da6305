#include "antigrasp/perturb/perturbation.h"

#include <cmath>
#include <numbers>

#include "antigrasp/core/angles.h"

namespace antigrasp {
namespace {

// Jaws that open to 40 mm hold a cube of 40 mm: what single precision takes off or adds, as a share
// of the opening, must not decide.
constexpr double kOpeningSlack = 1e-5;

// Whether step `i` of `total` is one of `marks` evenly spread ones, the first step among them.
bool IsMark(std::int64_t i, std::int64_t total, std::int64_t marks) {
  return i == 0 || (i * marks) / total != ((i - 1) * marks) / total;
}

}  // namespace

void Bind(OptionTable* table, PerturbOptions* options) {
  PerturbOptions& o = *options;
  table->Add("perturb.cone", &o.cone, 0.0, 80.0,
             "half angle of the friction cone that pairs are judged by, degrees; 0 = atan of the "
             "metric's friction");
  table->Add("perturb.max_width", &o.max_width, 0.0, 1e6,
             "widest pair of faces, metres as the metric scales the object; 0 = any");
  table->Add("perturb.unchecked", &o.unchecked,
             "the algorithm as printed: take back no move, even if it spoils the mesh");
  table->Add("perturb.history", &o.history,
             "count the antipodal pairs on the way and write history.csv");
}

PairLimits PairLimitsOf(const PerturbOptions& options, double friction, double metres_per_unit) {
  PairLimits limits;
  limits.cone_angle = options.cone > 0.0 ? options.cone * kDegree : std::atan(friction);
  if (options.max_width > 0.0) limits.max_width = options.max_width / metres_per_unit;
  limits.width_slack = kOpeningSlack;
  return limits;
}

MoveLimits GuardLimits(const PerturbOptions& options) {
  MoveLimits limits;
  if (!options.unchecked) return limits;
  limits.max_turn_per_move = std::numbers::pi;
  limits.min_height = 0.0;
  limits.check_intersections = false;
  return limits;
}

bool BeginPerturbation(const TriangleMesh& mesh, PerturbResult* result) {
  result->failure = WhyNotPrintable(mesh);  // first: rounding needs finite numbers
  if (result->failure.empty()) {
    result->start = InSinglePrecision(mesh);
    result->failure = WhyNotPrintable(result->start);
    if (!result->failure.empty()) result->failure += " in single precision";
  }
  if (!result->failure.empty()) result->failure = "before: " + result->failure;
  return result->failure.empty();
}

void EndPerturbation(const EditableMesh& mesh, PerturbResult* result) {
  result->mesh = mesh.mesh();
  const std::string why = WhyNotPrintable(result->mesh);
  if (!why.empty()) result->failure = "after: " + why;
}

PerturbClock::PerturbClock(std::int64_t iterations, bool history, const PairLimits& pairs,
                           const ProgressFn& progress)
    : iterations_(iterations), history_(history), pairs_(pairs), progress_(progress) {}

void PerturbClock::Tick(const EditableMesh& mesh, std::int64_t iteration,
                        PerturbResult* result) const {
  const bool last = iteration == iterations_;
  if (progress_ && iteration > 0) progress_(iteration, iterations_);
  if (history_ && (last || IsMark(iteration, iterations_, kHistoryCounts))) {
    result->history.push_back({iteration, CountAntipodalPairs(mesh.mesh(), pairs_)});
  }
}

}  // namespace antigrasp
