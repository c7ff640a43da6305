#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

#include "antigrasp/core/choice.h"
#include "antigrasp/quality/contact.h"

namespace antigrasp {

// The torque about its normal that a contact carries per unit of normal force.
enum class Torsion {
  kNone,    // hard finger, point contact with friction: none
  kDexNet,  // pi r^2 mu, what Dex-Net computes (not a torque per force: see docs/metric.md)
  kUniformPressure,  // 2/3 r mu: Coulomb friction under uniform pressure on a disc of radius r
};
constexpr auto ChoicesOf(Torsion) {
  return std::to_array<Choice<Torsion>>({{Torsion::kNone, "none"},
                                         {Torsion::kDexNet, "dexnet"},
                                         {Torsion::kUniformPressure, "uniform_pressure"}});
}

// The constants of one epsilon evaluation.
struct WrenchModel {
  double friction = 0.5;
  int cone_edges = 8;
  double finger_radius = 0.005;  // metres
  double torque_scale = 1000.0;  // 1 / metres
  Torsion torsion = Torsion::kDexNet;
};

// The torsion of model.torsion, before the torque scale.
double TorsionLimit(const WrenchModel& model);

using TangentFrames = std::array<std::array<Eigen::Vector3d, 2>, 2>;

// The 6 x (2 * cone_edges + 4) wrenches of Dex-Net's grasp matrix: cone edges of contact 1, of
// contact 2, then torsion +T1, +T2, -T1, -T2; rows force, torque * torque_scale about `com`. Hard
// fingers have no torsion columns: 6 x (2 * cone_edges).
Eigen::Matrix<double, 6, Eigen::Dynamic> GraspMatrix(
    const std::array<Contact, 2>& contacts, const Eigen::Vector3d& com, const WrenchModel& model,
    const std::optional<TangentFrames>& frames = std::nullopt);

// Epsilon (Ferrari and Canny 1992, L1): the distance from the origin to the boundary of the convex
// hull of those wrenches; 0 unless the origin is strictly inside (deeper than 1e-10). Exact: closed
// form when each contact lies inside the other's pyramid, a general exact method elsewhere. Two
// hard fingers cannot turn the object about their line: exactly 0.
double Epsilon(const std::array<Contact, 2>& contacts, const Eigen::Vector3d& com,
               const WrenchModel& model, const std::optional<TangentFrames>& frames = std::nullopt);

}  // namespace antigrasp
