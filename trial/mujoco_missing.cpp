#include "antigrasp/core/error.h"
#include "antigrasp/trial/physics_engine.h"

namespace antigrasp {

std::unique_ptr<PhysicsEngine> MakeMujocoEngine(const PhysicsOptions& /*options*/) {
  throw InputError("built without MuJoCo", "--engine mujoco",
                   "--engine model, or a build where libmujoco-dev is installed");
}

std::string MujocoVersion() { return {}; }

}  // namespace antigrasp
