#pragma once

#include <string>

#include "antigrasp/core/choice.h"
#include "antigrasp/core/options.h"

namespace antigrasp {

// An axis of a link, either way.
enum class LinkAxis { kX, kY, kZ, kMinusX, kMinusY, kMinusZ };
constexpr auto ChoicesOf(LinkAxis) {
  return std::to_array<Choice<LinkAxis>>({{LinkAxis::kX, "x"},
                                          {LinkAxis::kY, "y"},
                                          {LinkAxis::kZ, "z"},
                                          {LinkAxis::kMinusX, "-x"},
                                          {LinkAxis::kMinusY, "-y"},
                                          {LinkAxis::kMinusZ, "-z"}});
}

// How robot descriptions and files of grasps know a gripper. It enters no score. The base lies
// palm_distance + palm_depth behind the grasp's centre (gripper.h).
struct GripperBase {
  std::string name = "gripper";  // in ACRONYM, Dex-Net, isaac_grasp
  std::string asset;             // in GraspGen and MultiGripperGrasp; empty: the name
  std::string frame = "base";    // the link whose pose is written
  LinkAxis approach = LinkAxis::kZ, closing = LinkAxis::kX;  // of that link: out of the palm, and
                                                             // from jaw 1 to jaw 2
  std::string joints;  // of the fingers, a blank between names; empty: none are written
  double joint_open = 0.0, joint_closed = 0.0;  // of each: at the full opening, and at none
  const std::string& Asset() const { return asset.empty() ? name : asset; }
};

void Bind(OptionTable* table, GripperBase* base);  // keys "base.*"

}  // namespace antigrasp
