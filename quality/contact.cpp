#include "antigrasp/quality/contact.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace antigrasp {
namespace {

// Below this sine of the angle between d and x the projection of x is rounding noise.
constexpr double kParallel = 1e-10;

// Second column of the Householder reflection that LAPACK's SVD of the column d returns as U: the
// basis vector Dex-Net's search starts from, and keeps when no direction has a positive x part.
Eigen::Vector3d HouseholderSecondColumn(const Eigen::Vector3d& d) {
  const double beta = std::signbit(d.x()) ? d.norm() : -d.norm();
  const double tau = (beta - d.x()) / beta;
  const Eigen::Vector3d v(1.0, d.y() / (d.x() - beta), d.z() / (d.x() - beta));
  return Eigen::Vector3d::UnitY() - tau * v.y() * v;
}

}  // namespace

std::array<Eigen::Vector3d, 2> TangentFrame(const Eigen::Vector3d& d) {
  Eigen::Vector3d t1 = Eigen::Vector3d::UnitX() - d.x() * d;
  if (t1.norm() > kParallel) {
    // Twice: near the pole one projection leaves a part along d as large as rounding / |t1|.
    t1.normalize();
    t1 = (t1 - t1.dot(d) * d).normalized();
  } else {
    t1 = HouseholderSecondColumn(d);
  }
  return {t1, d.cross(t1)};
}

bool Slips(const Eigen::Vector3d& d, const Eigen::Vector3d& u, double friction) {
  const double normal_part = std::max(u.dot(d), 0.0);
  return (u - u.dot(d) * d).norm() > friction * normal_part;
}

bool SameGrasp(const Grasp& a, const Grasp& b, double separation) {
  const auto near = [&](std::size_t i, std::size_t j) {
    return (a.contacts[i].point - b.contacts[j].point).norm() < separation;
  };
  return (near(0, 0) && near(1, 1)) || (near(0, 1) && near(1, 0));
}

}  // namespace antigrasp
