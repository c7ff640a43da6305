#pragma once

#include <Eigen/Core>
#include <array>
#include <limits>
#include <optional>

#include "antigrasp/core/options.h"
#include "antigrasp/quality/epsilon.h"

namespace antigrasp {

// How a grasp is asked to resist a wrench. The defaults are Dex-Net's; each of the three switches
// replaces one of its habits that changes the answer.
struct WrenchResistanceOptions {
  double force_limit = 20.0;   // per contact: sum of its coefficients
  double tolerance = 1e-3;     // resisted when |G a - w|^2 is below
  double regularizer = 1e-10;  // picks the smallest of the coefficients that fit equally well
  bool oppose_target = false;  // the contacts give -w and so hold against w; Dex-Net: they give +w
  bool metric_torque = false;  // w's torque is in force x length; Dex-Net: times torque_scale
  bool limit_cone_only = false;  // torsion is free of the limit; Dex-Net: its coefficients count
};

struct WrenchResistance {
  bool resisted = false;  // Dex-Net's partial closure
  double quality = 0.0;   // 1 / (|a| + 1e-9) - 1 / (2 force_limit) when resisted: Dex-Net's metric
  double coefficient_norm = std::numeric_limits<double>::quiet_NaN();  // |a|
  double residual2 = std::numeric_limits<double>::quiet_NaN();         // |G a - w|^2
  Eigen::VectorXd coefficients;  // a, one per column of GraspMatrix
};

using Wrench = Eigen::Matrix<double, 6, 1>;

// Whether contacts of limited force can give the wrench w (force, torque about `com`):
//   minimise |G a - w|^2 + regularizer |a|^2,  a >= 0,  sum of a over each contact <= force_limit
// (Dex-Net cccf933, grasping/quality.py, wrench_in_positive_span), solved exactly. The limit is on
// coefficients: a contact whose normal_force is below 1 gives that much less; set it to 1 for
// newtons. Torsion columns have no force of their own. A contact without normal force (it slips)
// and numbers that are not finite resist nothing; there the norms stay NaN and `a` empty.
WrenchResistance ResistWrench(const std::array<Contact, 2>& contacts, const Eigen::Vector3d& com,
                              const WrenchModel& model, const Wrench& target,
                              const WrenchResistanceOptions& options = {},
                              const std::optional<TangentFrames>& frames = std::nullopt);

void Bind(OptionTable* table, WrenchResistanceOptions* options);  // keys "wrench.*"

}  // namespace antigrasp
