#pragma once

#include "antigrasp/core/passer.h"
#include "antigrasp/mesh/pass_mesh.h"
#include "antigrasp/perturb/scored_perturbation.h"

namespace antigrasp {

// A perturbed object for another process (core/passer.h).
inline void PassFields(Passer& pass, PerturbResult& result) {
  pass(result.start, result.mesh, result.failure, result.iterations, result.moved, result.no_gain,
       result.refused, result.no_pairs_left, result.history);
}
inline void PassFields(Passer& pass, ScoredPerturbation& scored) {
  pass(scored.before, scored.result, scored.graspability_before, scored.graspability_after,
       scored.pairs_before, scored.pairs_after, scored.normals, scored.change, scored.judge,
       scored.judge_before, scored.judge_after, scored.seconds);
}

}  // namespace antigrasp
