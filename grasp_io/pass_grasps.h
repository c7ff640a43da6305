#pragma once

#include "antigrasp/core/passer.h"
#include "antigrasp/grasp_io/grasp_set.h"
#include "antigrasp/mesh/pass_mesh.h"

namespace antigrasp {

// Grasps for another process (core/passer.h).
inline void PassFields(Passer& pass, PosedGrasp& grasp) {
  pass(grasp.id, grasp.center, grasp.axis, grasp.approach, grasp.width, grasp.quality,
       grasp.candidate, grasp.executions, grasp.held);
}
inline void PassFields(Passer& pass, GraspSet& set) {
  pass(set.object, set.metres_per_unit, set.mesh, set.grasps);
}

}  // namespace antigrasp
