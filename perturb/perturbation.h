#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "antigrasp/core/options.h"
#include "antigrasp/core/parallel.h"
#include "antigrasp/mesh/triangle_mesh.h"
#include "antigrasp/perturb/editable_mesh.h"
#include "antigrasp/perturb/face_pairs.h"

namespace antigrasp {

// What the three algorithms of section IV share. docs/perturbation.md says how the paper is read.
struct PerturbOptions {
  double cone = 0.0;       // half angle psi of the friction cone, degrees; 0 = atan(friction)
  double max_width = 0.0;  // widest pair (jaw opening), metres; 0 = any
  // Take back no move that turns a face inside out, takes its area or makes the mesh meet itself:
  // the algorithms as printed, whose result may be no solid.
  bool unchecked = false;
  bool history = false;  // count |F_a| on the way: kHistoryCounts times, IV-A in every iteration
};
void Bind(OptionTable* table, PerturbOptions* options);  // keys "perturb.*"
inline constexpr int kHistoryCounts = 20;
PairLimits PairLimitsOf(const PerturbOptions& options, double friction, double metres_per_unit);

// |F_a| on the way.
struct PairCount {
  std::int64_t iteration = 0;
  std::int64_t pairs = 0;
  std::int64_t below = -1;  // those with phi < psi; only IV-A knows it
};

struct PerturbResult {
  TriangleMesh start;   // what the algorithm began on: single precision, maybe decimated
  TriangleMesh mesh;    // what became of it
  std::string failure;  // why there is no result to print, in plain words; "" = there is one
  std::int64_t iterations = 0;
  std::int64_t moved = 0;    // iterations that changed the mesh
  std::int64_t no_gain = 0;  // iterations in which no move raised the angle within the limits
  std::array<std::int64_t, kNumMoveVerdicts> refused{};  // moves by verdict
  bool no_pairs_left = false;                            // it ended before its iterations
  std::vector<PairCount> history;
};

// The limits of a move under the common options; alpha of IV-B and the like are added by the
// caller.
MoveLimits GuardLimits(const PerturbOptions& options);

// Looks at the mesh, rounds it and fills `start`; false, with `failure` set, when it is no solid.
bool BeginPerturbation(const TriangleMesh& mesh, PerturbResult* result);
// Takes the mesh over and looks at it once more.
void EndPerturbation(const EditableMesh& mesh, PerturbResult* result);

// Called once an iteration: reports progress, counts |F_a| when it is time to.
class PerturbClock {
 public:
  PerturbClock(std::int64_t iterations, bool history, const PairLimits& pairs,
               const ProgressFn& progress);
  void Tick(const EditableMesh& mesh, std::int64_t iteration, PerturbResult* result) const;

 private:
  std::int64_t iterations_;
  bool history_;
  PairLimits pairs_;
  ProgressFn progress_;
};

}  // namespace antigrasp
