#include "antigrasp/quality/jaw_settling.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace antigrasp {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr double kGravity = 9.81;
constexpr double kStep = 0.01;        // s
constexpr double kSpeed = 0.04;       // of a jaw that nothing holds up, m/s
constexpr double kDrag = 12.0;        // N s/m, of the body at a force of 15 N
constexpr double kTurnDrag = 4.5e-3;  // N m s
constexpr double kDragForce = 15.0;
constexpr double kMargin = 0.5e-3;  // m: nearer than this is a contact
constexpr double kRest = 5e-3;      // m/s of anything
constexpr double kSlack = 1e-3;     // m: faces near a tip are kept that long
constexpr double kTouch = 1e-4;     // m: conservative advancement ends
constexpr int kCloseSteps = 60, kLoadSteps = 12, kLostSteps = 4;
constexpr int kSweeps = 30;
constexpr double kSolved = 3e-4;  // change of a contact force in a sweep, of the jaws' force

constexpr int kMost = 2 * kMostContacts;

// Velocities of the body, of its turning and of the jaws, each times the root of its drag: the
// drag's matrix is one. The eighth is padding.
using Motion = Eigen::Matrix<double, 8, 1>;

struct Touching {
  int tip;
  Vector3d normal;  // out of the object, gripper's frame
  double gap;
  // Along -normal, along two tangents, about the normal: what a unit force does to the motion, and
  // what the motion is there.
  std::array<Motion, 4> row;
  std::array<double, 4> compliance;
  std::array<double, 4> force{};
};

class ClosingJaws {
 public:
  ClosingJaws(const ContactSolid& solid, const Vector3d& com, double radius, const Fingertip& tip,
              const GripLoad& load, const Isometry3d& object, double opening, double friction)
      : solid_(solid),
        com_(com),
        radius_(radius),
        tip_(tip),
        load_(load),
        opening_(opening),
        friction_(friction),
        drag_(std::sqrt(kDrag * load.force / kDragForce)),
        turn_drag_(std::sqrt(kTurnDrag * load.force / kDragForce)),
        jaw_drag_(std::sqrt(2.0 * load.force / kSpeed)),
        turn_(object.linear()),
        place_(object * com) {
    for (TouchCache& cache : cache_) cache.slack = kSlack;
  }

  JawSettling::Grip Do() {
    JawSettling::Grip grip;
    grip.closed = Close();
    grip.held = grip.closed && Bears();
    grip.object.linear() = turn_;
    grip.object.translation() = place_ - turn_ * com_;
    grip.steps = steps_;
    return grip;
  }

 private:
  bool Close() {
    const std::optional<double> touch = TravelToTouch();
    if (!touch) return false;
    travel_ = *touch;
    int still = 0, apart = 0;
    for (int i = 0; i < kCloseSteps; ++i) {
      Step(Vector3d::Zero());
      if (Met()) return false;
      still = Pressed() && Resting() ? still + 1 : 0;
      if (still == 2) return true;
      apart = press_[0] > 0.0 || press_[1] > 0.0 ? 0 : apart + 1;
      if (apart == kLostSteps && !TravelToTouch()) return false;
    }
    return Pressed();
  }

  bool Bears() {
    for (const double side : {-1.0, 1.0}) {
      for (const int axis : {2, 0, 1}) {
        const Vector3d weight = side * load_.mass * kGravity * Vector3d::Unit(axis);
        if (!BearsOne(weight)) return false;
      }
    }
    return true;
  }

  // It may give way, turn or creep as long as both tips press on.
  bool BearsOne(const Vector3d& weight) {
    int apart = 0;
    for (int i = 0; i < kLoadSteps; ++i) {
      Step(weight);
      if (Met()) return false;
      if (Pressed() && Resting()) return true;
      apart = Pressed() ? 0 : apart + 1;
      if (apart == kLostSteps) return false;
    }
    return Pressed();
  }

  bool Pressed() const { return press_[0] > 0.0 && press_[1] > 0.0; }
  bool Met() const { return travel_ >= 0.5 * opening_; }
  bool Resting() const {
    return motion_.head<3>().norm() / drag_ + motion_.segment<3>(3).norm() / turn_drag_ * radius_ +
               std::abs(motion_[6]) / jaw_drag_ <
           kRest;
  }

  Vector3d TipCenter(int tip, double travel) const {
    const double out = 0.5 * opening_ + tip_.Half().x() - travel;
    return {tip == 0 ? -out : out, 0.0, 0.0};
  }
  Vector3d InMesh(const Vector3d& point) const {
    return turn_.transpose() * (point - place_) + com_;
  }
  SpherePose Ball(int tip, double travel) const {
    return {InMesh(TipCenter(tip, travel)), tip_.radius};
  }
  PadPose Pad(int tip, double travel) const {
    Isometry3d to_mesh;
    to_mesh.linear() = turn_.transpose();
    to_mesh.translation() = InMesh(Vector3d::Zero());
    return PadAt(tip_, to_mesh, TipCenter(tip, travel), tip == 0 ? 1.0 : -1.0);
  }

  // Conservative advancement from where the jaws are, past a body that stays where it is.
  std::optional<double> TravelToTouch() const {
    double travel = travel_;
    while (travel < 0.5 * opening_) {
      double clear = 0.5 * opening_;
      for (int tip = 0; tip < 2; ++tip) {
        clear = std::min(clear, tip_.shape == TipShape::kSphere
                                    ? solid_.Distance(Ball(tip, travel), clear)
                                    : solid_.Distance(Pad(tip, travel), clear));
      }
      if (clear < kTouch) return travel;
      travel += clear;
    }
    return std::nullopt;
  }

  // ---- one step ----

  void Step(const Vector3d& weight) {
    FindContacts();
    motion_.setZero();
    motion_.head<3>() = weight / drag_;
    motion_[6] = 2.0 * load_.force / jaw_drag_;
    for (int i = 0; i < count_; ++i) {
      for (std::size_t k = 0; k < 4; ++k) motion_ += touching_[i].force[k] * touching_[i].row[k];
    }
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
      if (Sweep() < kSolved * load_.force) break;
    }
    press_ = {};
    for (int i = 0; i < count_; ++i) press_[touching_[i].tip] += touching_[i].force[0];
    Advance();
    ++steps_;
  }

  void Advance() {
    place_ += kStep / drag_ * motion_.head<3>();
    const Vector3d turn = kStep / turn_drag_ * motion_.segment<3>(3);
    const double angle = turn.norm();
    if (angle > 0.0) {
      turn_ = Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix() * turn_;
    }
    travel_ += kStep / jaw_drag_ * motion_[6];
  }

  void FindContacts() {
    const std::array<Touching, kMost> before = touching_;
    const int count_before = count_;
    std::array<bool, kMost> taken{};
    count_ = 0;
    first_ = {-1, -1};
    for (int tip = 0; tip < 2; ++tip) {
      std::array<SurfaceContact, kMostContacts> found;
      const int most = kMostContacts;
      const int n =
          tip_.shape == TipShape::kSphere
              ? solid_.Touch(Ball(tip, travel_), kMargin, found.data(), 4, &cache_[tip])
              : solid_.Touch(Pad(tip, travel_), kMargin, found.data(), most, &cache_[tip]);
      if (n > 0) first_[tip] = count_;
      for (int k = 0; k < n; ++k) {
        touching_[count_] = Make(tip, found[k]);
        // Forces of the step before are a good guess of the next one's.
        for (int i = 0; i < count_before; ++i) {
          if (taken[i] || before[i].tip != tip) continue;
          if (before[i].normal.dot(touching_[count_].normal) < 0.95) continue;
          touching_[count_].force = before[i].force;
          taken[i] = true;
          break;
        }
        ++count_;
      }
    }
  }

  Touching Make(int tip, const SurfaceContact& contact) const {
    Touching made;
    made.tip = tip;
    made.normal = turn_ * contact.normal;
    made.gap = contact.distance;
    const Vector3d lever = turn_ * (contact.position - com_);
    const double closing = tip == 0 ? 1.0 : -1.0;
    // Tangents that follow the grasp, so that a step's friction may be carried over.
    const Vector3d& n = made.normal;
    const Vector3d across = std::abs(n.y()) < 0.9 ? Vector3d::UnitY() : Vector3d::UnitZ();
    const Vector3d y = (across - across.dot(n) * n).normalized();
    const std::array<Vector3d, 3> ways = {-n, y, n.cross(y)};
    for (std::size_t k = 0; k < 3; ++k) {
      made.row[k] << ways[k] / drag_, lever.cross(ways[k]) / turn_drag_,
          -closing * ways[k].x() / jaw_drag_, 0.0;
    }
    made.row[3] << Vector3d::Zero(), n / turn_drag_, 0.0, 0.0;
    for (std::size_t k = 0; k < 4; ++k) made.compliance[k] = made.row[k].squaredNorm();
    return made;
  }

  // Largest change of a force.
  double Sweep() {
    double change = 0.0;
    if (first_[0] >= 0 && first_[1] >= 0) {
      change = SolvePair(&touching_[first_[0]], &touching_[first_[1]]);
    }
    for (int i = 0; i < count_; ++i) {
      Touching& t = touching_[i];
      const bool in_pair = first_[0] >= 0 && first_[1] >= 0 && (i == first_[0] || i == first_[1]);
      if (!in_pair) {
        const double wanted =
            t.force[0] - (t.row[0].dot(motion_) + t.gap / kStep) / t.compliance[0];
        change = std::max(change, Set(&t, 0, std::max(0.0, wanted)));
      }
      const double bearable = friction_ * t.force[0];
      double y = t.force[1] - t.row[1].dot(motion_) / t.compliance[1];
      double z = t.force[2] - t.row[2].dot(motion_) / t.compliance[2];
      const double size = std::sqrt(y * y + z * z);
      if (size > bearable) {
        y *= bearable / size;
        z *= bearable / size;
      }
      change = std::max({change, Set(&t, 1, y), Set(&t, 2, z)});
      if (tip_.shape != TipShape::kSphere) continue;  // the patch of a pad is in its points
      const double most = tip_.Torsion() * bearable;
      const double about = t.force[3] - t.row[3].dot(motion_) / t.compliance[3];
      Set(&t, 3, std::clamp(about, -most, most));
    }
    return change;
  }

  // Both sides' first contacts at once: taken in turn, they pass the jaws' force to and fro.
  double SolvePair(Touching* a, Touching* b) {
    const double aa = a->compliance[0], bb = b->compliance[0], ab = a->row[0].dot(b->row[0]);
    const double free_a =
        a->row[0].dot(motion_) + a->gap / kStep - aa * a->force[0] - ab * b->force[0];
    const double free_b =
        b->row[0].dot(motion_) + b->gap / kStep - ab * a->force[0] - bb * b->force[0];
    const double determinant = aa * bb - ab * ab;
    double fa = 0.0, fb = 0.0;
    if (determinant > 1e-12 * aa * bb) {
      fa = (ab * free_b - bb * free_a) / determinant;
      fb = (ab * free_a - aa * free_b) / determinant;
    }
    if (!(fa > 0.0 && fb > 0.0)) {
      fa = std::max(0.0, -free_a / aa);
      fb = 0.0;
      if (free_b + ab * fa < 0.0) {
        fb = std::max(0.0, -free_b / bb);
        fa = 0.0;
      }
    }
    const double change = Set(a, 0, fa);
    return std::max(change, Set(b, 0, fb));
  }

  double Set(Touching* touching, std::size_t k, double force) {
    const double change = force - touching->force[k];
    if (change == 0.0) return 0.0;
    motion_ += change * touching->row[k];
    touching->force[k] = force;
    return std::abs(change);
  }

  const ContactSolid& solid_;
  const Vector3d com_;
  const double radius_;
  const Fingertip tip_;
  const GripLoad load_;
  const double opening_, friction_;
  const double drag_, turn_drag_, jaw_drag_;  // roots

  Eigen::Matrix3d turn_;
  Vector3d place_;  // of the centre of mass
  double travel_ = 0.0;
  Motion motion_ = Motion::Zero();
  std::array<Touching, kMost> touching_;
  int count_ = 0;
  std::array<int, 2> first_ = {-1, -1};
  std::array<double, 2> press_{};
  std::array<TouchCache, 2> cache_;
  int steps_ = 0;
};

}  // namespace

JawSettling::JawSettling(const Vector3d& com, double radius, const Fingertip& tip,
                         const GripLoad& load)
    : com_(com), radius_(radius), tip_(tip), load_(load) {}

JawSettling::Grip JawSettling::Close(const ContactSolid& solid, const Isometry3d& object,
                                     double opening, double friction) const {
  return ClosingJaws(solid, com_, radius_, tip_, load_, object, opening, friction).Do();
}

}  // namespace antigrasp
