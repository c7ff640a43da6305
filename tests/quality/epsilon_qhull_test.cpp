#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "antigrasp/core/parallel.h"
#include "tests/quality/qhull_oracle.h"
#include "tests/quality/random_grasps.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

// Qhull computes in the given coordinates, so its own error grows with the size of the wrenches.
constexpr double kQhullError = 2e-14;

struct Comparison {
  double excess = 0.0;  // difference beyond Qhull's own error, relative to epsilon
  bool same_decision = true;
  bool positive = false;
};

Comparison Compare(const RandomGrasp& grasp) {
  const auto wrenches = GraspMatrix(grasp.contacts, grasp.com, grasp.model);
  const double depth = HullDepthByQhull(wrenches);
  const double error = kQhullError * wrenches.norm();
  const double epsilon = Epsilon(grasp.contacts, grasp.com, grasp.model);
  Comparison result;
  const double exact = depth > 1e-10 ? depth : 0.0;  // NaN: a flat hull
  result.positive = exact > 0.0;
  result.same_decision = (epsilon > 0.0) == result.positive || std::abs(depth - 1e-10) <= error;
  if (result.positive && epsilon > 0.0) {
    result.excess = std::max(0.0, std::abs(epsilon - exact) - error) / exact;
  }
  return result;
}

RandomGrasp CaseFor(std::uint64_t i) {
  RngStream rng(21, "qhull", i);
  // From well inside the cones to far outside, where torsion alone may close the hull.
  RandomGrasp grasp = DrawRandomGrasp(i % 4 == 0 ? 1.8 : 1.05, 8, &rng);
  grasp.model.friction = rng.Uniform(0.05, 1.2);
  const double scale = std::exp(rng.Uniform(-3.0, 3.0));  // of the object
  for (Contact& contact : grasp.contacts) contact.point *= scale;
  grasp.com *= scale * (i % 7 == 0 ? 20.0 : 1.0);  // centre of mass far away
  grasp.model.finger_radius *= scale;
  grasp.model.torque_scale /= i % 3 == 0 ? 1.0 : scale;
  return grasp;
}

// Antiparallel normals along the contact line, the line along an axis or not, the centre of mass on
// it or not, several contacts in one place.
RandomGrasp DegenerateCaseFor(std::uint64_t i) {
  RngStream rng(22, "degenerate", i);
  RandomGrasp grasp = DrawRandomGrasp(1.0, 8, &rng);
  const Vector3d line =
      i % 2 == 0 ? Vector3d(Vector3d::Unit(static_cast<int>(i / 2 % 3))) : DrawDirection(&rng);
  grasp.contacts[0] = {-0.02 * line, -line, 1.0};
  grasp.contacts[1] = {0.02 * line, line, 1.0};
  if (i % 3 == 0) grasp.com = Vector3d::Zero();
  if (i % 3 == 1) grasp.com = 0.01 * line;
  if (i % 5 == 0) grasp.contacts[1].point += 0.004 * line.unitOrthogonal();
  if (i % 11 == 0) grasp.contacts[1].normal = grasp.contacts[0].normal;  // pushing the same way
  if (i % 13 == 0) grasp.contacts[1].point = grasp.contacts[0].point;
  return grasp;
}

template <typename MakeCase>
void ExpectAgreement(std::int64_t count, MakeCase make_case, std::int64_t at_least_positive) {
  std::vector<Comparison> results(static_cast<std::size_t>(count));
  ParallelFor(count, 0, [&](std::int64_t i) {
    results[static_cast<std::size_t>(i)] = Compare(make_case(static_cast<std::uint64_t>(i)));
  });
  std::int64_t positive = 0;
  for (std::size_t i = 0; i < results.size(); ++i) {
    EXPECT_LT(results[i].excess, 1e-9) << "case " << i;
    EXPECT_TRUE(results[i].same_decision) << "case " << i;
    positive += results[i].positive ? 1 : 0;
  }
  EXPECT_GT(positive, at_least_positive);
}

// A millisecond each, most of it Qhull's.
TEST(EpsilonAgainstQhull, RandomCasesAgree) { ExpectAgreement(2000, CaseFor, 1000); }

TEST(EpsilonAgainstQhull, DegenerateCasesAgree) { ExpectAgreement(1000, DegenerateCaseFor, 250); }

}  // namespace
}  // namespace antigrasp
