#pragma once

#include <string>
#include <vector>

#include "antigrasp/grasp_io/grasp_set.h"
#include "antigrasp/quality/given_grasps.h"

// Grasps in JSON: GraspGen's and MultiGripperGrasp's, one object a file.
namespace antigrasp {

std::string GraspGenJson(const GraspSet& set, const GraspFileAbout& about);
std::string MultiGripperJson(const GraspSet& set, const GraspFileAbout& about);

// Either of them, and ACRONYM's twin in JSON (transforms, object_scale at the top). InputError for
// what is no JSON, none of the three or without grasps, for a damaged pose and for another gripper.
std::vector<GivenGrasp> ReadJsonGrasps(const std::string& path, const GripperBase& base,
                                       const MetricOptions& metric);

}  // namespace antigrasp
