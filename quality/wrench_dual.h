#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "antigrasp/quality/epsilon.h"

namespace antigrasp {

// The polar dual Q = { y : w . y <= 1 for every wrench w } of a two-contact grasp, as generators.
// Epsilon = 1 / max |y| over Q.
//
// Write y = (y_f, y_m) and p_i = y_f + s y_m x r_i (r_i the arm of contact i, s the torque scale).
// The friction rows of contact i say f . p_i <= 1: p_i lies in a cone with apex d_i / m_i and edges
// c_ij. The two cones meet in one equation, (p_1 - p_2) . D = 0, D the unit vector along the
// contact line. p_1 and p_2 fix y up to u, the coordinate along the kernel direction (-D x r_1, D /
// s) / L, L the distance of the contacts. The torsion rows bound u from both sides by functions
// linear in one number h(p_1, p_2):
//   -a <= u <= a   and   (h - b) / e <= u <= (h + b) / e,
// so that Q is a polytope over the set C of pairs (p_1, p_2), cut by |h| <= b + e a and with ridges
// where the bounds cross, h = +-(b - e a).
struct DualPoint {
  Eigen::Matrix<double, 6, 1> y;  // part orthogonal to the kernel direction
  double g = 0.0;                 // (p_1 - p_2) . D; 0 on C
  double h = 0.0;
  double offset = 0.0;  // coordinate along the kernel direction = u - offset
  double t = 0.0;       // homogeneous: 1 for a point, 0 for a direction
};

// The linear maps behind those numbers, one grasp's.
struct DualMap {
  Eigen::Vector3d line;  // D
  double length;
  double torque_scale;
  Eigen::Vector3d arm;           // r_1
  Eigen::Vector3d kernel_force;  // force part of the kernel direction
  double kernel2;                // its squared length
  TangentFrames frames;
  int cone_edges;
  double inset;                           // friction * cos(pi / cone_edges)
  std::array<Eigen::Vector3d, 2> inward;  // d_i
  std::array<Eigen::Vector3d, 2> apex;    // d_i / m_i
  std::array<double, 2> along;            // d_i . D
  std::size_t base;  // the contact whose torsion bounds u directly: larger |d_i . D|
  double a, b, e;    // torsion bounds

  DualPoint At(const Eigen::Vector3d& p1, const Eigen::Vector3d& p2, double t) const;
};

// nullopt when the wrenches cannot span (a contact without force, no friction, no torsion,
// coincident contacts, numbers that are not finite): epsilon is 0.
std::optional<DualMap> MakeDualMap(const std::array<Contact, 2>& contacts,
                                   const Eigen::Vector3d& com, const WrenchModel& model,
                                   const TangentFrames& frames);

struct WrenchDual {
  DualPoint apex;                               // (d_1 / m_1, d_2 / m_2)
  std::array<std::vector<DualPoint>, 2> edges;  // directions (c_1j, 0) and (0, c_2j), in order
  double a = 0.0, b = 0.0, e = 0.0;             // torsion bounds
  double kernel2 = 0.0;                         // squared length of the kernel direction

  // The planes of h where Q has vertices over an edge of C: its two ends, then its two ridges; and
  // the value of u there.
  struct Cut {
    double h, u;
  };
  std::array<Cut, 4> Cuts() const {
    return {{{b + e * a, a}, {-b - e * a, -a}, {e * a - b, a}, {b - e * a, -a}}};
  }
  // The squared norms of the two points of Q over a vertex of C, the larger one; 0 outside Q.
  double Norm2Over(double y_norm2, double h, double offset) const;
};

WrenchDual MakeWrenchDual(const DualMap& map);

}  // namespace antigrasp
