#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "antigrasp/core/check.h"
#include "antigrasp/quality/epsilon.h"

namespace antigrasp {

double TorsionLimit(const WrenchModel& model) {
  switch (model.torsion) {
    case Torsion::kNone:
      return 0.0;
    case Torsion::kDexNet:
      return std::numbers::pi * model.finger_radius * model.finger_radius * model.friction;
    case Torsion::kUniformPressure:
      return 2.0 / 3.0 * model.finger_radius * model.friction;
  }
  AG_CHECK(false, "unknown torsion model");
}

Eigen::Matrix<double, 6, Eigen::Dynamic> GraspMatrix(const std::array<Contact, 2>& contacts,
                                                     const Eigen::Vector3d& com,
                                                     const WrenchModel& model,
                                                     const std::optional<TangentFrames>& frames) {
  const int edges = model.cone_edges;
  AG_CHECK(edges >= 3, "a friction cone needs at least 3 edges");
  Eigen::Matrix<double, 6, Eigen::Dynamic> wrenches(
      6, 2 * edges + (model.torsion == Torsion::kNone ? 0 : 4));
  for (int i = 0; i < 2; ++i) {
    const Contact& contact = contacts[static_cast<std::size_t>(i)];
    const Eigen::Vector3d d = -contact.normal;
    const auto [t1, t2] = frames ? (*frames)[static_cast<std::size_t>(i)] : TangentFrame(d);
    const Eigen::Vector3d arm = contact.point - com;
    for (int j = 0; j < edges; ++j) {
      const double angle = 2.0 * std::numbers::pi * j / edges;
      const Eigen::Vector3d force =
          contact.normal_force *
          (d + model.friction * (std::cos(angle) * t1 + std::sin(angle) * t2));
      wrenches.col(i * edges + j) << force, model.torque_scale * arm.cross(force);
    }
    if (model.torsion == Torsion::kNone) continue;
    // Both signs; no force part, as in Dex-Net: the contact may twist without pressing.
    const double torsion = TorsionLimit(model) * model.torque_scale * contact.normal_force;
    wrenches.col(2 * edges + i) << Eigen::Vector3d::Zero(), torsion * d;
    wrenches.col(2 * edges + 2 + i) << Eigen::Vector3d::Zero(), -torsion * d;
  }
  return wrenches;
}

}  // namespace antigrasp
