#pragma once

#include <string>
#include <vector>

#include "antigrasp/grasp_io/grasp_set.h"
#include "antigrasp/quality/given_grasps.h"

// isaac_grasp 1.0, the YAML of Isaac Sim's grasp editor, Isaac ROS and GraspDataGen: one object a
// file, poses of the link that the robot description names.
namespace antigrasp {

std::string IsaacGraspYaml(const GraspSet& set, const GraspFileAbout& about);

// InputError for what is no YAML, another format or without grasps, for a damaged pose and for
// another gripper.
std::vector<GivenGrasp> ReadIsaacGrasps(const std::string& path, const GripperBase& base,
                                        const MetricOptions& metric);

}  // namespace antigrasp
