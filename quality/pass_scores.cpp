#include "antigrasp/quality/pass_scores.h"

namespace antigrasp {

void PassFields(Passer& pass, Contact& contact) {
  pass(contact.point, contact.normal, contact.normal_force);
}

void PassFields(Passer& pass, Grasp& grasp) {
  pass(grasp.contacts, grasp.center, grasp.axis, grasp.width, grasp.approach);
}

void PassFields(Passer& pass, NoiseDraw& draw) {
  pass(draw.object_translation, draw.object_rotation, draw.grasp_translation, draw.grasp_rotation,
       draw.friction);
}

void PassFields(Passer& pass, ScoredGrasp& grasp) {
  pass(grasp.grasp, grasp.quality, grasp.draws, grasp.candidate);
}

void PassFields(Passer& pass, RejectedGrasps::Reason& reason) { pass(reason.name, reason.count); }

void PassFields(Passer& pass, RejectedGrasps& rejected) { pass(rejected.reasons, rejected.copies); }

void PassFields(Passer& pass, Graspability& score) {
  pass(score.status, score.value, score.ci_low, score.ci_high, score.mean, score.fraction_nonzero,
       score.attempts, score.rejected, score.scale, score.seconds, score.grasps);
}

void PassFields(Passer& pass, ScoredObject& scored) {
  pass(scored.name, scored.status, scored.note, scored.center_of_mass, scored.extent, scored.score);
}

void PassFields(Passer& pass, GivenGrasp& grasp) {
  pass(grasp.object, grasp.id, grasp.frame, grasp.metres_per_unit, grasp.says_scale, grasp.center,
       grasp.axis, grasp.approach, grasp.width, grasp.candidate, grasp.of_a_candidate);
}

void PassFields(Passer& pass, GivenScore& score) {
  pass(score.status, score.epsilon, score.robust_quality, score.reachable, score.grasp);
}

void PassFields(Passer& pass, Verdict& verdict) { pass(verdict.score, verdict.status); }

}  // namespace antigrasp
