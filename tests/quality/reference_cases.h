#pragma once

#include <string>
#include <vector>

#include "antigrasp/quality/epsilon.h"

// tests/data/quality/contacts.csv: 500 two-contact soft-finger grasps with the answers of a port of
// Dex-Net's own metric, its hull made exact with Qhull (option Qt).
namespace antigrasp {

struct ReferenceCase {
  std::string id, family;
  std::array<Contact, 2> contacts;  // normal_force as the reference applied it, 0 where it slipped
  Eigen::Vector3d com;
  WrenchModel model;
  TangentFrames frames;  // from Dex-Net's grid search
  bool has_jaw_direction = false;
  std::array<Eigen::Vector3d, 2> jaw_direction;  // not unit
  std::string cone_status;                       // ok, slip1, slip2, slip12
  double matrix_norm = 0.0;                      // Frobenius; NaN where it slipped
  double epsilon = 0.0;                          // with `frames`
  double epsilon_own_frame = 0.0;                // with the continuum frame
  bool force_closure = false;                    // Dex-Net's default, either sign of the normals
  bool force_closure_signed = false;
  Eigen::Matrix<double, 6, 1> target;  // wrench to resist, torque in scaled units
  double force_limit = 0.0;
  double dexnet_resistance = 0.0;  // as Dex-Net's own solver leaves it
  double resistance = 0.0;         // the rest with the optimum of the same programme; NaN
  double coefficient_norm = 0.0;   // where it slipped
  double residual2 = 0.0;
  bool below_limit = false;  // the reference is exact there (NNLS), to 1e-6 or so elsewhere
};

std::vector<ReferenceCase> ReadReferenceCases();

}  // namespace antigrasp
