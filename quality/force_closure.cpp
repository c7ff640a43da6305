#include "antigrasp/quality/force_closure.h"

#include <Eigen/Geometry>
#include <cmath>

namespace antigrasp {
namespace {

// Whether the unit direction `ahead` lies in the cone about the inward normal. A sine against a
// cosine: exact where an arccosine would lose half its digits, near the axis.
bool InCone(const Eigen::Vector3d& normal, const Eigen::Vector3d& ahead, double friction,
            NormalSense sense) {
  const double along = -normal.dot(ahead);
  const double into = sense == NormalSense::kLine ? std::abs(along) : along;
  return into > 0.0 && normal.cross(ahead).norm() <= friction * into;
}

}  // namespace

bool ForceClosure(const std::array<Contact, 2>& contacts, double friction, NormalSense sense) {
  const Eigen::Vector3d between = contacts[1].point - contacts[0].point;
  const double length = between.norm();
  if (!(length > 0.0) || !std::isfinite(length)) return false;
  const Eigen::Vector3d ahead = between / length;
  return InCone(contacts[0].normal, ahead, friction, sense) &&
         InCone(contacts[1].normal, -ahead, friction, sense);
}

}  // namespace antigrasp
