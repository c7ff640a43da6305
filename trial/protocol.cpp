#include "antigrasp/trial/protocol.h"

#include "antigrasp/core/check.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

std::vector<Vector3d> SixWays() {
  const Vector3d x = Vector3d::UnitX(), y = Vector3d::UnitY(), z = Vector3d::UnitZ();
  return {-z, z, x, -x, y, -y};
}

// Along the way in, and tilted by atan 2 to both sides of both axes.
std::vector<Vector3d> FiveTugs() {
  const Vector3d in = -Vector3d::UnitZ(), x = 2.0 * Vector3d::UnitX(), y = 2.0 * Vector3d::UnitY();
  std::vector<Vector3d> tugs = {in, in + x, in - x, in + y, in - y};
  for (Vector3d& tug : tugs) tug.normalize();
  return tugs;
}

}  // namespace

Protocol ProtocolOf(ProtocolName name) {
  const Vector3d x = Vector3d::UnitX(), y = Vector3d::UnitY();
  Protocol protocol;
  protocol.name = name;
  switch (name) {
    case ProtocolName::kSixWays:
      for (const int g : {1, 3, 8}) {
        protocol.stages.push_back({std::to_string(g) + " g", g * kGravity, SixWays(), 0.1});
      }
      return protocol;
    case ProtocolName::kPaper:
      protocol.choice = GraspChoice::kBestUnused;
      protocol.stages = {{"carried", 2.0, {x, -x, y, -y}, 0.2, true}};
      return protocol;
    case ProtocolName::kGraspDataGen:
      protocol.table = false;
      protocol.mass = 1.0;
      protocol.friction = 1.0;
      protocol.close_seconds = 1.0;
      protocol.stages = {{"five tugs", kGravity, FiveTugs(), 0.5}};
      return protocol;
    case ProtocolName::kDexGraspBench:
      protocol.table = false;
      protocol.mass = 0.1;
      protocol.friction = 0.6;
      protocol.torsion = 0.02;
      protocol.rule = HeldRule::kInPlace;
      protocol.stages = {{"six runs", 10.0, SixWays(), 2.0, false, true}};
      return protocol;
  }
  AG_CHECK(false, "a protocol of the list");
  return {};
}

}  // namespace antigrasp
