#include "antigrasp/bundle/bundle_files.h"
#include "antigrasp/bundle/pinch_scene.h"
#include "antigrasp/core/format.h"

namespace antigrasp {
namespace {

std::string Constant(const char* name, double value) {
  return std::string(name) + " = " + FormatDouble(value) + "\n";
}

constexpr const char* kImports =
    R"(# Two boxes of 30 g, each pinched at 1 N: that of friction 0.14 falls,
# that of 0.16 stays (0.147 holds its weight). python3 self_check_bullet.py; metres, kilograms.
import sys

import pybullet as p

)";

// Bullet multiplies the frictions of a pair: the balls have 1.
constexpr const char* kScript = R"(
p.connect(p.DIRECT)
p.setGravity(0, 0, -9.81)
p.setTimeStep(0.001)


def add_box(y, friction):
    shape = p.createCollisionShape(p.GEOM_BOX, halfExtents=[BOX_SIDE / 2] * 3)
    box = p.createMultiBody(BOX_MASS, shape, basePosition=[0, y, HEIGHT])
    p.changeDynamics(box, -1, lateralFriction=friction, linearDamping=0, angularDamping=0)
    return box


def add_ball(y, side):
    """On a slide of the world: a joint that no motor holds."""
    shape = p.createCollisionShape(p.GEOM_SPHERE, radius=BALL_RADIUS)
    ball = p.createMultiBody(
        baseMass=0,
        basePosition=[side * BALL_ASIDE, y, HEIGHT],
        linkMasses=[BALL_MASS],
        linkCollisionShapeIndices=[shape],
        linkVisualShapeIndices=[-1],
        linkPositions=[[0, 0, 0]],
        linkOrientations=[[0, 0, 0, 1]],
        linkInertialFramePositions=[[0, 0, 0]],
        linkInertialFrameOrientations=[[0, 0, 0, 1]],
        linkParentIndices=[0],
        linkJointTypes=[p.JOINT_PRISMATIC],
        linkJointAxis=[[-side, 0, 0]],
    )
    p.changeDynamics(ball, 0, lateralFriction=1, linearDamping=0, angularDamping=0, jointDamping=0)
    p.setJointMotorControl2(ball, 0, p.VELOCITY_CONTROL, force=0)
    return ball


boxes = {name: add_box(y, friction) for name, y, friction in BOXES}
balls = [add_ball(y, side) for _, y, _ in BOXES for side in (-1, 1)]
for _ in range(2000):
    for ball in balls:
        p.setJointMotorControl2(ball, 0, p.TORQUE_CONTROL, force=PINCH)
    p.stepSimulation()
sunk = {name: HEIGHT - p.getBasePositionAndOrientation(box)[0][2] for name, box in boxes.items()}
for name, metres in sunk.items():
    print(f"{name}: sank {1000 * metres:.2f} mm in 2 s")
sys.exit(0 if sunk["falls"] > 0.1 and sunk["stays"] < 0.001 else 1)
)";

}  // namespace

std::string BulletSelfCheck() {
  std::string text = kImports;
  text += Constant("PINCH", kSpring * kSpringRest);
  text += Constant("HEIGHT", kPinchHeight);
  text += Constant("BOX_SIDE", kBoxSide) + Constant("BOX_MASS", kBoxMass);
  text += Constant("BALL_RADIUS", kBallRadius) + Constant("BALL_MASS", kBallMass);
  text += Constant("BALL_ASIDE", kBallAside);
  std::string boxes;
  for (const PinchedBox& box : kPinchedBoxes) {
    boxes += (boxes.empty() ? "(\"" : ", (\"") + std::string(box.name) + "\", " +
             FormatDouble(box.y) + ", " + FormatDouble(box.friction) + ")";
  }
  return text + "BOXES = [" + boxes + "]\n" + kScript;
}

}  // namespace antigrasp
