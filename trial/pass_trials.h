#pragma once

#include "antigrasp/core/passer.h"
#include "antigrasp/trial/physics_trial.h"
#include "antigrasp/trial/trial_summary.h"

// Trials for another process (core/passer.h).
namespace antigrasp {

void PassFields(Passer& pass, TrialGrasp& grasp);
void PassFields(Passer& pass, ExecutedGrasp& grasp);
void PassFields(Passer& pass, PhysicsTrial& trial);
void PassFields(Passer& pass, TrialSummary& summary);

}  // namespace antigrasp
