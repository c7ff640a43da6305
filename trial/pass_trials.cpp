#include "antigrasp/trial/pass_trials.h"

#include "antigrasp/quality/pass_scores.h"

namespace antigrasp {

void PassFields(Passer& pass, TrialGrasp& grasp) {
  pass(grasp.grasp, grasp.pose, grasp.quality, grasp.draws, grasp.place, grasp.candidate);
}

void PassFields(Passer& pass, ExecutedGrasp& grasp) {
  pass(grasp.planned, grasp.series, grasp.draws);
}

void PassFields(Passer& pass, PhysicsTrial& trial) {
  pass(trial.tried, trial.mass, trial.metres_per_unit, trial.poses, trial.wanted, trial.candidates,
       trial.grasps);
}

void PassFields(Passer& pass, TrialSummary& summary) {
  pass(summary.object, summary.status, summary.mass, summary.poses, summary.wanted,
       summary.candidates, summary.grasps, summary.executions, summary.held, summary.group,
       summary.outcomes, summary.untrusted, summary.predicted, summary.quality);
}

}  // namespace antigrasp
