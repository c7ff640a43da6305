#pragma once

#include <string>
#include <utility>
#include <vector>

#include "antigrasp/grasp_io/grasp_set.h"

namespace antigrasp {

// Every joint of the fingers and its value at an opening, m; linear between none and the full one.
std::vector<std::pair<std::string, double>> JointValues(const GraspFileAbout& about,
                                                        double opening);

}  // namespace antigrasp
