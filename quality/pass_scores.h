#pragma once

#include "antigrasp/core/passer.h"
#include "antigrasp/quality/given_grasps.h"
#include "antigrasp/quality/judge.h"
#include "antigrasp/quality/scored_object.h"

// Scores and grasps for another process (core/passer.h).
namespace antigrasp {

void PassFields(Passer& pass, Contact& contact);
void PassFields(Passer& pass, Grasp& grasp);
void PassFields(Passer& pass, NoiseDraw& draw);
void PassFields(Passer& pass, ScoredGrasp& grasp);
void PassFields(Passer& pass, RejectedGrasps::Reason& reason);
void PassFields(Passer& pass, RejectedGrasps& rejected);
void PassFields(Passer& pass, Graspability& score);
void PassFields(Passer& pass, ScoredObject& scored);
void PassFields(Passer& pass, GivenGrasp& grasp);
void PassFields(Passer& pass, GivenScore& score);
void PassFields(Passer& pass, Verdict& verdict);

}  // namespace antigrasp
