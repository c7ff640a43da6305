#include "antigrasp/grasp_io/joint_values.h"

#include <algorithm>
#include <sstream>

namespace antigrasp {

std::vector<std::pair<std::string, double>> JointValues(const GraspFileAbout& about,
                                                        double opening) {
  const GripperBase& base = about.base;
  const double share = std::clamp(opening / about.metric.jaw_opening, 0.0, 1.0);
  const double value = base.joint_closed + share * (base.joint_open - base.joint_closed);
  std::vector<std::pair<std::string, double>> values;
  std::istringstream names(base.joints);
  for (std::string name; names >> name;) values.emplace_back(name, value);
  return values;
}

}  // namespace antigrasp
