#include "antigrasp/trial/execution.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "antigrasp/core/angles.h"

namespace antigrasp {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr double kStill = 0.001;  // m/s of any point of the body, and of the jaws
constexpr double kStillSeconds = 0.010;
constexpr double kSettled = 0.005;  // m/s: a body that sticks and moves no faster stays
constexpr int kSettledSteps = 5;
constexpr double kResting = 0.0005;  // m/s: no more than this, it stays whether it sticks or not
constexpr int kRestingSteps = 10;
constexpr double kJammed = 0.0002;  // m/s of body and jaws
constexpr double kJammedSeconds = 0.300;
constexpr double kLyingSeconds =
    0.040;  // on its table, before a jaw comes: until it is at rest there
constexpr double kLostSeconds = 0.030;  // without a touch
constexpr double kGone = 0.08;          // m
constexpr double kMet = 0.0002;         // m between the fingertips
constexpr double kTurnedAway = 30.0 * kDegree;
constexpr double kLiftSpeed = 0.1, kLiftAcceleration = 1.0;  // m/s, m/s2
constexpr double kInPlaceMove = 0.05, kInPlaceTurn = 15.0 * kDegree;

double AngleBetween(const Isometry3d& a, const Isometry3d& b) {
  return Eigen::AngleAxisd(Eigen::Matrix3d(a.linear().transpose() * b.linear())).angle();
}

// How far the table has gone down after so many seconds.
double Lifted(double seconds) {
  const double ramp = kLiftSpeed / kLiftAcceleration;
  if (seconds < ramp) return 0.5 * kLiftAcceleration * seconds * seconds;
  return kLiftSpeed * (seconds - 0.5 * ramp);
}

class Run {
 public:
  Run(PhysicsEngine* engine, const GrippedBody& body, const PhysicsOptions& options,
      const Protocol& protocol, const GripStart& start, Pace pace, const ReplayFn& replay)
      : engine_(*engine),
        body_(body),
        options_(options),
        protocol_(protocol),
        start_(start),
        early_(pace == Pace::kEarly),
        replay_(replay),
        weight_(start.table == kNoTable ? Vector3d(Vector3d::Zero())
                                        : Vector3d(-kGravity * start.up)) {}

  Execution Do() {
    if (Starts()) Continue();
    if (broken_) result_.outcome = Outcome::kUnstable;
    result_.seconds = result_.steps * options_.time_step + idle_;
    return result_;
  }

 private:
  // Whether there is anything to simulate; the jaws are taken to the last step before they touch.
  bool Starts() {
    if (Overlaps(start_.travel)) {
      result_.outcome = Outcome::kStartedInCollision;
      return false;
    }
    if (early_) {
      const std::optional<double> touch = TravelToTouch(start_.body, start_.travel);
      if (!touch) {
        result_.outcome = Outcome::kNeverTouched;
        return false;
      }
      const double lying = start_.table == kNoTable ? 0.0 : kLyingSeconds;
      CloseFreely(*touch - lying * options_.close_speed);
    }
    engine_.Begin(start_);
    engine_.SetAcceleration(weight_);
    engine_.SetBrake(start_.table == kNoTable);
    return true;
  }

  // The steps that the jaws would take with nothing in their way, up to this travel.
  void CloseFreely(double most) {
    for (double speed = 0.0;;) {
      speed += options_.time_step * options_.DriveForce(speed) / options_.finger_mass;
      const double next = start_.travel + options_.time_step * speed;
      if (!(next <= most)) return;
      start_.travel = next;
      start_.speed = speed;
      idle_ += options_.time_step;
    }
  }

  void Continue() {
    result_.outcome = Outcome::kLostClosing;
    if (!Close()) {
      if (!touched_) result_.outcome = Outcome::kNeverTouched;
      return;
    }
    closed_ = state_.body;
    result_.closing_move = (closed_.translation() - start_.body.translation()).norm();
    result_.closing_turn = AngleBetween(start_.body, closed_);
    result_.contacts = state_.contacts;
    result_.penetration = deepest_;
    held_ = true;
    engine_.SetBrake(false);
    engine_.Save();
    held_ = (!protocol_.table || Lift()) && held_;
    if (held_) engine_.SetTable(kNoTable);
    for (const LoadStage& stage : protocol_.stages) {
      if (!held_ || !Bears(stage)) break;
      ++result_.stages;
      result_.penetration = deepest_;  // not what happens while it is lost
    }
    result_.outcome = result_.stages > 0           ? Outcome::kHeld
                      : result_.turn > kTurnedAway ? Outcome::kTurnedAway
                                                   : Outcome::kSlipped;
  }

  // Closed: both press and all is still, or still held at the end of the time for it.
  bool Close() {
    const double limit = protocol_.close_seconds;
    double still = 0.0, jammed = 0.0;
    for (double t = idle_; t < limit && !broken_; t += options_.time_step) {
      Step();
      still = Pressed() && Speed() < kStill && std::abs(state_.travel_speed) < kStill
                  ? still + options_.time_step
                  : 0.0;
      if (!early_) continue;
      if (still > kStillSeconds) return true;
      // One jaw presses it against the table for good, the other one cannot come.
      const bool rests = Speed() < kJammed && std::abs(state_.travel_speed) < kJammed;
      jammed = rests && !Pressed() ? jammed + options_.time_step : 0.0;
      if (jammed > kJammedSeconds || Gone()) return false;
    }
    return !broken_ && Pressed() && !Met();
  }

  // The table goes; held when the body hangs in the jaws.
  bool Lift() {
    const double limit = protocol_.lift_height / kLiftSpeed + 0.5 * kLiftSpeed / kLiftAcceleration;
    engine_.SetAcceleration(weight_ - kLiftAcceleration * start_.up);
    bool speeding = true;
    rest_ = {};
    for (double t = 0.0; t < limit && !broken_; t += options_.time_step) {
      if (speeding && t >= kLiftSpeed / kLiftAcceleration) {
        engine_.SetAcceleration(weight_);
        speeding = false;
      }
      table_ = start_.table - Lifted(t);
      engine_.SetTable(table_);
      Step();
      Follow();
      if (early_ && AtRest()) return true;
      if (early_ && Gone()) return false;
    }
    return !broken_ && Pressed() && !Met();
  }

  bool Bears(const LoadStage& stage) {
    for (const Vector3d& direction : stage.directions) {
      if (stage.from_grasp) engine_.Restore();
      engine_.SetAcceleration(AccelerationOf(stage, direction));
      rest_ = {};
      for (double t = 0.0; t < stage.seconds && !broken_; t += options_.time_step) {
        Step();
        Follow();
        if (early_ && (AtRest() || Gone())) break;
        if (early_ && protocol_.rule == HeldRule::kInPlace && !InPlace()) break;
      }
      if (broken_ || !StillHeld()) return held_ = false;
    }
    return true;
  }

  Vector3d AccelerationOf(const LoadStage& stage, const Vector3d& direction) const {
    if (!stage.level) return stage.acceleration * direction;
    // Axes of the table: up, and two level ones from the gripper's own.
    const Vector3d across = start_.up.cross(Vector3d::UnitX());
    const Vector3d y = across.norm() > 1e-6 ? across.normalized() : start_.up.unitOrthogonal();
    const Vector3d x = y.cross(start_.up);
    return weight_ +
           stage.acceleration * (direction.x() * x + direction.y() * y + direction.z() * start_.up);
  }

  void Step() {
    state_ = engine_.Step();
    ++result_.steps;
    broken_ = broken_ || state_.broken || !state_.body.matrix().allFinite();
    const bool first = state_.press[0] > 0.0, second = state_.press[1] > 0.0;
    since_any_ = first || second ? 0.0 : since_any_ + options_.time_step;
    since_both_ = first && second ? 0.0 : since_both_ + options_.time_step;
    touched_ = touched_ || first || second;
    if (first && second) deepest_ = std::max(deepest_, state_.penetration);
    if (replay_) {
      replay_({result_.steps * options_.time_step, state_, table_, engine_.Contacts()});
    }
  }

  // How far the body has gone in the grasp, while it is in there.
  void Follow() {
    if (!Pressed()) return;
    result_.move = std::max(result_.move, Move());
    result_.turn = std::max(result_.turn, AngleBetween(closed_, state_.body));
  }

  double Move() const { return (state_.body.translation() - closed_.translation()).norm(); }
  double Speed() const { return state_.velocity.norm() + state_.turning.norm() * body_.radius; }
  bool Pressed() const { return since_both_ < 0.5 * kLostSeconds && touched_; }
  bool Met() const { return start_.opening - 2.0 * state_.travel < kMet; }
  bool InPlace() const {
    return (state_.body.translation() - start_.body.translation()).norm() < kInPlaceMove &&
           AngleBetween(start_.body, state_.body) < kInPlaceTurn;
  }
  bool StillHeld() const {
    if (protocol_.rule == HeldRule::kInPlace) return InPlace();
    return Pressed() && !Met() && Move() < kGone;
  }
  bool Gone() const {
    if (Met() || (held_ && Move() > kGone)) return true;
    // One jaw may push the body away and the other one catch it: it is gone when it is, or while
    // the jaws close lies still, where neither comes.
    return touched_ && since_any_ > kLostSeconds && (held_ || Speed() < kStill) &&
           !TravelToTouch(state_.body, state_.travel);
  }

  // In the jaws alone, where nothing changes any more: every contact sticks, or the body does not
  // move. (A contact that has slid bears all that friction can bear when the body rests, too.)
  bool AtRest() {
    const bool held = !state_.on_table && state_.press[0] > 0.0 && state_.press[1] > 0.0;
    rest_.sticking = held && state_.sticks && Speed() < kSettled ? rest_.sticking + 1 : 0;
    rest_.still = held && Speed() < kResting ? rest_.still + 1 : 0;
    return rest_.sticking >= kSettledSteps || rest_.still >= kRestingSteps;
  }

  // ---- where the jaws are and come ----

  Vector3d TipCenter(int tip, double travel) const {
    const double out = 0.5 * start_.opening + options_.tip.Half().x() - travel;
    return {tip == 0 ? -out : out, 0.0, 0.0};
  }

  bool Overlaps(double travel) const {
    const Isometry3d to_body = start_.body.inverse();
    for (int tip = 0; tip < 2; ++tip) {
      const Vector3d center = TipCenter(tip, travel);
      if (options_.tip.shape == TipShape::kSphere
              ? body_.solid.Overlaps(SpherePose{to_body * center, options_.tip.radius})
              : body_.solid.Overlaps(PadAt(options_.tip, to_body, center, tip == 0 ? 1.0 : -1.0)))
        return true;
    }
    return false;
  }

  double Clearance(const Isometry3d& body, double travel, double limit) const {
    const Isometry3d to_body = body.inverse();
    double nearest = limit;
    for (int tip = 0; tip < 2; ++tip) {
      const Vector3d center = TipCenter(tip, travel);
      nearest = std::min(
          nearest,
          options_.tip.shape == TipShape::kSphere
              ? body_.solid.Distance(SpherePose{to_body * center, options_.tip.radius}, nearest)
              : body_.solid.Distance(PadAt(options_.tip, to_body, center, tip == 0 ? 1.0 : -1.0),
                                     nearest));
    }
    return nearest;
  }

  // Conservative advancement of the jaws from this travel on, past a body that stays where it is.
  std::optional<double> TravelToTouch(const Isometry3d& body, double travel) const {
    constexpr double kNear = 2e-5;
    const double most = 0.5 * start_.opening;
    while (travel < most) {
      const double clear = Clearance(body, travel, most);
      if (clear < kNear) return travel;
      travel += clear;
    }
    return std::nullopt;
  }

  PhysicsEngine& engine_;
  const GrippedBody& body_;
  PhysicsOptions options_;
  const Protocol& protocol_;
  GripStart start_;
  bool early_;
  ReplayFn replay_;
  Vector3d weight_;

  struct Rest {
    int sticking = 0, still = 0;  // steps in a row
  };

  GripState state_;
  Rest rest_;
  Isometry3d closed_ = Isometry3d::Identity();
  double table_ = start_.table, since_any_ = 0.0, since_both_ = 0.0, deepest_ = 0.0, idle_ = 0.0;
  bool touched_ = false, held_ = false, broken_ = false;
  Execution result_;
};

}  // namespace

Execution Execute(PhysicsEngine* engine, const GrippedBody& body, const PhysicsOptions& options,
                  const Protocol& protocol, GripStart start, Pace pace, const ReplayFn& replay) {
  return Run(engine, body, options, protocol, start, pace, replay).Do();
}

}  // namespace antigrasp
