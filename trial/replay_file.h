#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <filesystem>
#include <limits>
#include <string>
#include <utility>
#include <vector>

// Executions to look at, as docs/formats.md, "Replays" has them. Metres, newtons, seconds, all in
// the gripper's frame.
namespace antigrasp {

// One moment of an execution.
struct ReplayMoment {
  double seconds = 0.0;
  Eigen::Isometry3d object = Eigen::Isometry3d::Identity();  // of the mesh's frame
  std::array<Eigen::Vector3d, 2> tips;                       // centres of the fingertips
  // Contacts: where, and the force on the object.
  std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>> forces = {};
  double table = -std::numeric_limits<double>::infinity();  // height along up; this: there is none
};

struct Replay {
  std::string object, protocol, outcome;
  bool before = false;  // of the baseline
  int grasp = 0, execution = 0;
  double friction = 0.0;
  double metres_per_unit = 1.0;
  bool pad = false;  // the fingertip: a pad of half sizes `half`, or a ball of radius half.x()
  Eigen::Vector3d half = Eigen::Vector3d::Zero();
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  std::vector<ReplayMoment> moments = {};  // rising in time, as many as there are
};

inline constexpr std::size_t kMostReplayFrames = 120;

// Writes them all as replays.json. Of more than 120 moments evenly chosen ones, the first and last
// among them; what an unstable simulation made of numbers is left out, and a replay of fewer than
// two moments with it. Some 25 KB a replay.
void WriteReplays(const std::filesystem::path& path, const std::vector<Replay>& replays);

}  // namespace antigrasp
