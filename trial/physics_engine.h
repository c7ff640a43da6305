#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "antigrasp/contact/fingertip.h"
#include "antigrasp/core/options.h"
#include "antigrasp/trial/gripped_body.h"

// What a trial asks of a physics engine: one rigid body between two fingertips that slide towards
// each other, above a table or in the air, moved step by step.
//
// All in the gripper's frame: the origin lies midway between the fingertips, x points from tip 1 to
// tip 2, z against the way in, from the fingertips to the palm. The gripper does not move; lifting
// is a table that goes away, carrying an acceleration. Metres, kilograms, seconds, newtons.
namespace antigrasp {

// Of every execution of a trial.
struct PhysicsOptions {
  Fingertip tip;
  double force = 15.0;        // of each jaw when it is held up, N
  double close_speed = 0.04;  // of each jaw when nothing is in its way, m/s
  double finger_mass = 1.0;   // kg, each, what its drive adds included
  double table_friction = 0.5;
  double time_step = 0.001;  // s
  // What a jaw's drive does at this speed, N.
  double DriveForce(double speed) const { return force * (1.0 - speed / close_speed); }
};
void Bind(OptionTable* table, PhysicsOptions* options);  // keys "trial.*"

// 0.5 N at the jaws' speed, about what friction on a table takes; N s/m and N m s/rad.
inline constexpr double kBrake = 12.0, kTurnBrake = 0.0045;

inline constexpr double kNoTable = -std::numeric_limits<double>::infinity();

// How an execution begins: everything is at rest but for the jaws.
struct GripStart {
  Eigen::Isometry3d body = Eigen::Isometry3d::Identity();  // pose of the body
  double opening = 0.05;  // between the fingertips' surfaces when the jaws are open
  double travel = 0.0;    // of each jaw from there
  double speed = 0.0;     // of each jaw, m/s
  double friction = 0.5;  // between fingertips and body
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();  // unit, against gravity
  double table = kNoTable;                        // the table is {p : up . p <= table}
};

struct GripState {
  Eigen::Isometry3d body = Eigen::Isometry3d::Identity();
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  // of the centre of mass
  Eigen::Vector3d turning = Eigen::Vector3d::Zero();   // angular velocity, rad/s
  double travel = 0.0, travel_speed = 0.0;             // of the jaws, their mean
  std::array<double, 2> press{};                       // sum of the normal forces on each tip, N
  int contacts = 0;                                    // of the tips that carry a force
  bool on_table = false;                               // some force from the table
  bool sticks = false;  // every tip presses, and none of its contacts is within 5 % of slipping
  double penetration = 0.0;  // the deepest of a tip, m
  bool broken = false;       // numbers that are no physics any more
};

// A contact as a replay shows it: where, and the force on the body.
struct ContactForce {
  Eigen::Vector3d position, force;
};

class PhysicsEngine {
 public:
  virtual ~PhysicsEngine() = default;

  virtual void Load(const GrippedBody& body, double mass) = 0;  // the body must outlive its use
  virtual void Begin(const GripStart& start) = 0;
  // What a free body is accelerated with from the next step on: gravity and the gripper's motion.
  virtual void SetAcceleration(const Eigen::Vector3d& acceleration) = 0;
  virtual void SetTable(double table) = 0;  // GripStart::table
  // Brakes the body in the air as a table would while the jaws close (kBrake, kTurnBrake). Begin()
  // lets it go.
  virtual void SetBrake(bool on) = 0;
  virtual GripState Step() = 0;
  // One place to come back to: the state of the last Save, with the acceleration of now.
  virtual void Save() = 0;
  virtual void Restore() = 0;
  virtual std::vector<ContactForce> Contacts() const = 0;  // of the last step
};

// MuJoCo with contacts of ours (mesh_contact.h). One per thread: an engine is not shared.
// InputError in a build without MuJoCo.
std::unique_ptr<PhysicsEngine> MakeMujocoEngine(const PhysicsOptions& options);
std::string MujocoVersion();  // "2.2.2"; empty in a build without it

}  // namespace antigrasp
