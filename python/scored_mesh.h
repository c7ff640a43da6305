#pragma once

#include <memory>

#include "antigrasp/quality/scored_object.h"

namespace antigrasp::python {

// antigrasp.Grasps: those of a score, which they keep alive.
struct GraspsObject {
  std::shared_ptr<ScoredObject> scored;
};

}  // namespace antigrasp::python
