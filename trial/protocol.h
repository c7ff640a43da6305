#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "antigrasp/core/choice.h"
#include "antigrasp/core/options.h"

// How a grasp is tried, by the name of who proposed it (docs/trials.md has the sources).
namespace antigrasp {

inline constexpr double kGravity = 9.81;  // m/s2

enum class ProtocolName { kSixWays, kPaper, kGraspDataGen, kDexGraspBench };
constexpr auto ChoicesOf(ProtocolName) {
  return std::to_array<Choice<ProtocolName>>({{ProtocolName::kSixWays, "six-ways"},
                                              {ProtocolName::kPaper, "paper"},
                                              {ProtocolName::kGraspDataGen, "graspdatagen"},
                                              {ProtocolName::kDexGraspBench, "dexgraspbench"}});
}

// When an execution counts as held at the end of a stage.
enum class HeldRule {
  kBothPress,  // both fingertips still press on the object
  kInPlace     // it never moved 50 mm or turned 15 degrees
};

// Which of an object's grasps are executed.
enum class GraspChoice {
  kAll,        // every planned one
  kBestUnused  // series: a plan anew, then the best grasp that was not executed yet, five times
};

// Loads one after another; an execution passes the stage when it is held at the end of it.
struct LoadStage {
  std::string name;                         // "1 g"
  double acceleration;                      // m/s2 along each direction
  std::vector<Eigen::Vector3d> directions;  // unit: of the gripper's frame, or see `level`
  double seconds;                           // each
  bool level = false;       // directions are of the table (z up), and weight stays on beside them
  bool from_grasp = false;  // each direction begins where the jaws had closed
};

struct Protocol {
  ProtocolName name = ProtocolName::kSixWays;
  bool table = true;      // the object rests on one in a stable pose and is lifted off it; else it
                          // floats, and is braked while the jaws close
  double mass = 0.0;      // kg; 0 = the object's own
  double friction = 0.0;  // 0 = the metric's
  double torsion = 0.0;   // length, m; 0 = the fingertip's
  double close_seconds = 1.2;  // at most
  double lift_height = 0.1;    // m, off the table
  HeldRule rule = HeldRule::kBothPress;
  GraspChoice choice = GraspChoice::kAll;
  std::vector<LoadStage> stages;  // the first one decides what "held" means
};

Protocol ProtocolOf(ProtocolName name);

}  // namespace antigrasp
