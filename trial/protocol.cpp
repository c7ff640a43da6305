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
  switch (name) {
    case ProtocolName::kSixWays:
      return {name,
              true,
              0.0,
              0.0,
              0.0,
              1.2,
              0.1,
              HeldRule::kBothPress,
              GraspChoice::kAll,
              {{"1 g", kGravity, SixWays(), 0.1},
               {"3 g", 3 * kGravity, SixWays(), 0.1},
               {"8 g", 8 * kGravity, SixWays(), 0.1}}};
    case ProtocolName::kPaper:
      return {name,
              true,
              0.0,
              0.0,
              0.0,
              1.2,
              0.1,
              HeldRule::kBothPress,
              GraspChoice::kBestUnused,
              {{"carried", 2.0, {x, -x, y, -y}, 0.2, true}}};
    case ProtocolName::kGraspDataGen:
      return {name,
              false,
              1.0,
              1.0,
              0.0,
              1.0,
              0.0,
              HeldRule::kBothPress,
              GraspChoice::kAll,
              {{"five tugs", kGravity, FiveTugs(), 0.5}}};
    case ProtocolName::kDexGraspBench:
      return {name,
              false,
              0.1,
              0.6,
              0.02,
              1.2,
              0.0,
              HeldRule::kInPlace,
              GraspChoice::kAll,
              {{"six runs", 10.0, SixWays(), 2.0, false, true}}};
  }
  AG_CHECK(false, "a protocol of the list");
  return {};
}

}  // namespace antigrasp
