// The engine against what is known on paper: when a body slips, turns, stays.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "antigrasp/trial/execution.h"
#include "tests/trial/physics_shapes.h"

namespace antigrasp {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// No table; the jaws close on a body that floats, then it is pulled one way.
Protocol Pull(const Vector3d& direction, double seconds, double acceleration = kGravity) {
  Protocol protocol = ProtocolOf(ProtocolName::kSixWays);
  protocol.table = false;
  protocol.stages = {{"pull", acceleration, {direction}, seconds}};
  return protocol;
}

struct Bench {
  Bench(const TriangleMesh& mesh, const PhysicsOptions& physics, double kilograms = 0.0)
      : options(physics),
        body(MakeGrippedBody(mesh)),
        mass(kilograms > 0.0 ? kilograms : 1000.0 * body.volume),
        engine(MakeMujocoEngine(physics)) {
    engine->Load(body, mass);
  }

  // `gripper`: columns are the gripper's axes in the frame of the mesh; `com`: where the centre of
  // mass is, in the gripper's frame.
  Execution Do(const Matrix3d& gripper, const Vector3d& com, double friction,
               const Protocol& protocol, Pace pace = Pace::kEarly,
               const ReplayFn& replay = nullptr) {
    GripStart start;
    start.opening = 0.08;
    start.friction = friction;
    start.body.linear() = gripper.transpose() * body.from_object.linear().transpose();
    start.body.translation() = com;
    return Execute(engine.get(), body, options, protocol, start, pace, replay);
  }

  // The lowest friction at which it is held, as an angle in degrees; by halving.
  double Threshold(const std::function<bool(double)>& held, double low, double high) const {
    while (high - low > 0.002) {
      const double middle = 0.5 * (low + high);
      (held(std::tan(middle * kDegree)) ? high : low) = middle;
    }
    return 0.5 * (low + high);
  }

  PhysicsOptions options;
  GrippedBody body;
  double mass;
  std::unique_ptr<PhysicsEngine> engine;
};

// Pinched so that the axis bisects a flat face and the bevelled one over it, the line between the
// contacts through the centre of mass. Along the wedge the weight pushes the body out of it, across
// it does not. 20 N, half a second.
class Wedge : public ::testing::TestWithParam<double> {
 protected:
  double ThresholdOf(bool along) const {
    PhysicsOptions physics;
    physics.force = 20.0;
    Bench bench(BevelledCube(GetParam(), 0.04), physics);
    const double half = 0.5 * GetParam() * kDegree;
    Matrix3d gripper;
    gripper.col(0) = Vector3d(std::cos(half), std::sin(half), 0.0);
    gripper.col(1) = Vector3d(-std::sin(half), std::cos(half), 0.0);
    gripper.col(2) = Vector3d::UnitZ();
    const Vector3d com(0.0, -physics.tip.radius * std::sin(half), 0.0);
    const Protocol pull = Pull(along ? Vector3d(-Vector3d::UnitY()) : Vector3d::UnitZ(), 0.5);
    const double found = bench.Threshold(
        [&](double friction) {
          const Execution e = bench.Do(gripper, com, friction, pull, Pace::kFixed);
          return e.stages > 0 && e.move < 0.001;
        },
        0.5 * GetParam() - 1.0, 0.5 * GetParam() + 3.0);
    const double load = bench.mass * kGravity / (2.0 * physics.force);
    const double tangent = std::hypot(std::tan(half), load / std::cos(half));
    const double paper = along ? half + std::atan(load) : std::atan(tangent);
    return found - paper / kDegree;
  }
};

TEST_P(Wedge, AcrossItSlipsAtTheAngleOnPaper) { EXPECT_NEAR(ThresholdOf(false), 0.0, 0.02); }
TEST_P(Wedge, AlongItSlipsAtTheAngleOnPaper) { EXPECT_NEAR(ThresholdOf(true), 0.0, 0.02); }
INSTANTIATE_TEST_SUITE_P(Degrees, Wedge, ::testing::Values(10.0, 15.0, 26.0));

// Two pads bear 2 mu N.
TEST(MujocoEngine, ABlockBetweenPadsSlipsWhenFrictionBearsLessThanHalfItsWeight) {
  PhysicsOptions physics;
  physics.tip.shape = TipShape::kPad;
  Bench bench(shapes::Box(Vector3d::Constant(0.04)), physics, 0.5);
  const double limit = bench.mass * kGravity / (2.0 * physics.force);
  const auto move = [&](double friction) {
    return bench
        .Do(Matrix3d::Identity(), Vector3d::Zero(), friction, Pull(-Vector3d::UnitZ(), 0.5),
            Pace::kFixed)
        .move;
  };
  EXPECT_LT(move(1.01 * limit), 1e-4);
  EXPECT_GT(move(0.99 * limit), 1e-3);
}

// Each ball bears a torque of 2/3 mu r N beside a force of mu N: together as on an ellipse. The
// weight pulls at a lever of 10 mm about the grasp axis.
TEST(MujocoEngine, ABodyTurnsAboutTheGraspAxisWhenItsWeightOutweighsTheTorsion) {
  PhysicsOptions physics;
  Bench bench(shapes::Box({0.04, 0.08, 0.04}), physics);
  const double weight = bench.mass * kGravity, lever = 0.01;
  const double force = 0.5 * weight / physics.force;
  const double torque = 0.5 * weight * lever / (physics.force * physics.tip.Torsion());
  const double limit = std::hypot(force, torque);
  const auto turn = [&](double friction) {
    return bench
        .Do(Matrix3d::Identity(), {0.0, lever, 0.0}, friction, Pull(-Vector3d::UnitZ(), 0.5),
            Pace::kFixed)
        .turn;
  };
  EXPECT_LT(turn(1.02 * limit), 1.0 * kDegree);
  EXPECT_GT(turn(0.98 * limit), 10.0 * kDegree);
}

TEST(MujocoEngine, AHeldBodyCreepsLessThanAHundredthOfAMillimetreInTwoSeconds) {
  PhysicsOptions physics;
  Bench bench(shapes::Box(Vector3d::Constant(0.04)), physics);
  Vector3d at_first = Vector3d::Zero(), at_last = Vector3d::Zero();
  const Execution e =
      bench.Do(Matrix3d::Identity(), Vector3d::Zero(), 0.3, Pull(-Vector3d::UnitZ(), 2.1),
               Pace::kFixed, [&](const ReplayFrame& frame) {
                 if (frame.seconds < 1.31) at_first = frame.state.body.translation();
                 at_last = frame.state.body.translation();
               });
  EXPECT_EQ(e.outcome, Outcome::kHeld);
  EXPECT_GT(e.steps, 3000);  // 1.2 s of closing, 2.1 s of pulling
  EXPECT_LT((at_last - at_first).norm(), 1e-5);
}

TEST(MujocoEngine, HeldAtRestItPressesWithTheJawsForceAndPenetratesLittle) {
  PhysicsOptions physics;
  Bench bench(shapes::Box(Vector3d::Constant(0.04)), physics);
  GripState last;
  const Execution e =
      bench.Do(Matrix3d::Identity(), Vector3d::Zero(), 0.5, Pull(Vector3d::UnitX(), 0.1, 0.0),
               Pace::kFixed, [&](const ReplayFrame& frame) { last = frame.state; });
  EXPECT_EQ(e.outcome, Outcome::kHeld);
  EXPECT_NEAR(last.press[0], physics.force, 0.02 * physics.force);
  EXPECT_NEAR(last.press[1], physics.force, 0.02 * physics.force);
  EXPECT_TRUE(e.Trusted());
  EXPECT_TRUE(last.sticks);
}

// The force is the jaws' whatever the mass: a body of 1 g would give way by 0.18 mm.
TEST(MujocoEngine, ALightBodyAtRestIsTrustedToo) {
  const PhysicsOptions physics;
  Bench bench(shapes::Box(Vector3d::Constant(0.04)), physics, 0.001);
  GripState last;
  const Execution e = bench.Do(Matrix3d::Identity(), Vector3d::Zero(), 0.5,
                               ProtocolOf(ProtocolName::kDexGraspBench), Pace::kFixed,
                               [&](const ReplayFrame& frame) { last = frame.state; });
  EXPECT_EQ(e.outcome, Outcome::kHeld);
  EXPECT_LT(last.penetration, 1e-4);
}

// Falling freely: half g t^2, with the step's own rounding of it (semi-implicit Euler).
TEST(MujocoEngine, NothingHoldsABodyBesideTheJaws) {
  PhysicsOptions physics;
  Bench bench(shapes::Box(Vector3d::Constant(0.02)), physics);
  GripStart start;
  start.body.translation() = Vector3d(0.0, 0.2, 0.0);
  bench.engine->Begin(start);
  bench.engine->SetAcceleration({0.0, 0.0, -kGravity});
  GripState state;
  for (int i = 0; i < 100; ++i) state = bench.engine->Step();
  EXPECT_NEAR(state.body.translation().z(), -0.5 * kGravity * 0.1 * 0.101, 1e-12);
  EXPECT_NEAR(state.velocity.z(), -kGravity * 0.1, 1e-12);
}

// A cube lies on the table with friction: tilted by less than the friction angle it stays.
TEST(MujocoEngine, TheTableHoldsABodyUpToItsFrictionAngle) {
  PhysicsOptions physics;
  physics.table_friction = 0.3;
  Bench bench(shapes::Box(Vector3d::Constant(0.04)), physics);
  const auto speed = [&](double tangent) {
    GripStart start;
    start.body.translation() = Vector3d(0.0, 0.3, 0.0);
    start.table = -0.02;
    bench.engine->Begin(start);
    bench.engine->SetAcceleration(kGravity * Vector3d(0.0, tangent, -1.0));
    GripState state;
    for (int i = 0; i < 300; ++i) state = bench.engine->Step();
    return state.velocity.norm();
  };
  EXPECT_LT(speed(0.29), 1e-4);
  EXPECT_NEAR(speed(0.31), 0.01 * kGravity * 0.3, 0.2 * 0.01 * kGravity * 0.3);
}

}  // namespace
}  // namespace antigrasp
