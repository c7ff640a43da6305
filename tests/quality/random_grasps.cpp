#include "tests/quality/random_grasps.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace antigrasp {

RandomGrasp DrawRandomGrasp(double spread, int cone_edges, RngStream* rng) {
  RandomGrasp grasp;
  grasp.model.friction = rng->Uniform(0.05, 1.5);
  grasp.model.cone_edges = cone_edges;
  grasp.model.finger_radius = rng->Uniform(0.002, 0.03);
  grasp.model.torque_scale = std::exp(rng->Uniform(0.0, 8.0));
  const Eigen::Vector3d line = DrawDirection(rng);
  grasp.contacts[0].point = DrawPoint(0.02, rng);
  grasp.contacts[1].point = grasp.contacts[0].point + rng->Uniform(0.01, 0.08) * line;
  for (std::size_t i = 0; i < 2; ++i) {
    const Eigen::Vector3d ahead = i == 0 ? line : Eigen::Vector3d(-line);
    const Eigen::AngleAxisd around(rng->Uniform(0.0, 2.0 * std::numbers::pi), ahead);
    const Eigen::Vector3d hinge = around * ahead.unitOrthogonal();
    const double tilt = rng->Uniform(0.0, spread) * std::atan(grasp.model.friction);
    grasp.contacts[i].normal = -(Eigen::AngleAxisd(tilt, hinge) * ahead);
    grasp.contacts[i].normal_force = rng->Uniform(0.5, 1.0);
  }
  grasp.com = DrawPoint(0.02, rng);
  return grasp;
}

}  // namespace antigrasp
