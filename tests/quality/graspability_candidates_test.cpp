// What a graspability does with its candidates and its options, step by step from the parts.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "antigrasp/core/statistics.h"
#include "antigrasp/quality/antipodal_sampler.h"
#include "antigrasp/quality/epsilon.h"
#include "antigrasp/quality/graspability.h"
#include "antigrasp/quality/reachability.h"
#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

TEST(GraspQuality, IsEpsilonAboutTheMeanOfATetrahedronsCorners) {
  // Corners 0, e_x, e_y, e_z: the centre of mass is their mean, at 1/4 of the edge, the bounding
  // box's centre at 1/2. Every constant differs from its default.
  MetricOptions options;
  ApplyNoisePreset("none", &options);
  options.num_draws = 1;
  options.friction = 1.0;
  options.cone_edges = 6;
  options.finger_radius = 0.007;
  options.torque_scale = 300.0;
  options.torsion = Torsion::kUniformPressure;
  options.object_min_extent = 0.03;
  options.jaw_opening = 0.06;
  options.collision = Collision::kJaws;
  const Graspability g = EvaluateGraspability(shapes::Tetrahedron(), options, 1, 0);
  EXPECT_DOUBLE_EQ(g.scale, 0.03);
  ASSERT_GT(g.grasps.size(), 20u);
  const WrenchModel model{1.0, 6, 0.007, 300.0, Torsion::kUniformPressure};
  int differ = 0;
  for (const ScoredGrasp& scored : g.grasps) {
    const auto& contacts = scored.grasp.contacts;
    const double epsilon = Epsilon(contacts, Vector3d::Constant(0.0075), model);
    EXPECT_NEAR(scored.quality, epsilon, 1e-9 * epsilon);
    const double of_box = Epsilon(contacts, Vector3d::Constant(0.015), model);
    differ += std::abs(of_box - epsilon) > 0.01 * epsilon ? 1 : 0;
  }
  EXPECT_GT(differ, 15);
}

TEST(GraspQuality, WeighsTorquesPerMetreOfTheRescaledObject) {
  // Epsilon stays the same when an object grows by 2 and the torque scale halves; torsion, r^2 s,
  // asks for r by the root of 2. The scale of the mesh itself is nothing.
  MetricOptions small;
  ApplyNoisePreset("none", &small);
  small.num_draws = 1;
  small.collision = Collision::kJaws;
  MetricOptions large = small;
  large.object_min_extent *= 2.0;
  large.jaw_opening *= 2.0;
  large.grasp_separation *= 2.0;
  const TriangleMesh mesh = shapes::Box({3.0, 4.0, 7.0});
  const Graspability a = EvaluateGraspability(mesh, small, 1, 0);
  EXPECT_NE(EvaluateGraspability(mesh, large, 1, 0).value, a.value);
  large.torque_scale = 500.0;
  large.finger_radius *= std::sqrt(2.0);
  const Graspability b = EvaluateGraspability(mesh, large, 1, 0);
  EXPECT_EQ(b.scale, 2.0 * a.scale);
  ASSERT_EQ(a.grasps.size(), b.grasps.size());
  for (std::size_t i = 0; i < a.grasps.size(); ++i) {
    EXPECT_NEAR(b.grasps[i].quality, a.grasps[i].quality, 1e-6 * a.grasps[i].quality);
  }
}

// Both pairs of contacts within the separation, one way round or the other.
bool Near(const Grasp& a, const Grasp& b, double separation) {
  const auto apart = [&](std::size_t i) {
    return std::max((a.contacts[0].point - b.contacts[i].point).norm(),
                    (a.contacts[1].point - b.contacts[1 - i].point).norm());
  };
  return std::min(apart(0), apart(1)) < separation;
}

TEST(Graspability, CountsEachCandidateUnderItsOwnReason) {
  // A post in the hole of a torus: a finger hardly fits between them.
  const TriangleMesh mesh =
      shapes::Joined(shapes::Torus(1.6, 1.0, 24, 12), shapes::Cylinder(0.3, 3.0, 12));
  MetricOptions options;
  options.grasp_separation = 0.006;
  options.num_draws = 1;
  options.max_attempts = 1500;
  options.num_grasps = 1000;
  const Graspability g = EvaluateGraspability(mesh, options, 7, 3);
  const TriangleMesh scaled = Transformed(mesh, g.scale, Vector3d::Zero());
  const RayScene scene(scaled);
  const AntipodalSampler sampler(scaled, scene, options.friction, options.jaw_opening);
  const GripperCollision gripper(scaled, scene, options.gripper);
  std::array<int, 3> reasons{};
  int copies = 0, turned_copies = 0, collides = 0;
  std::vector<Grasp> kept;
  for (std::uint64_t candidate = 0; candidate < 1500; ++candidate) {
    RngStream rng(7, "grasp", 3, candidate);
    GraspRejection why{};
    const auto grasp = sampler.Try(&rng, &why);
    if (!grasp) {
      ++reasons[static_cast<std::size_t>(why)];
      continue;
    }
    bool copy = false, same_way = false;
    for (const Grasp& other : kept) {
      if (!Near(*grasp, other, options.grasp_separation)) continue;
      copy = true;
      same_way |= grasp->axis.dot(other.axis) > 0.0;
    }
    if (copy) {
      ++copies;
      turned_copies += same_way ? 0 : 1;
    } else if (!gripper.FreeApproach(*grasp, options.jaw_opening)) {
      ++collides;
    } else {
      kept.push_back(*grasp);
    }
  }
  EXPECT_EQ(g.attempts, 1500);
  EXPECT_EQ(g.rejected.Of("nothing within the opening"), reasons[0]);
  EXPECT_EQ(g.rejected.Of("slip"), reasons[1]);
  EXPECT_EQ(g.rejected.Of("jaw blocked"), reasons[2]);
  EXPECT_EQ(g.rejected.copies, copies);
  EXPECT_EQ(g.rejected.Of("gripper collides"), collides);
  EXPECT_EQ(g.grasps.size(), kept.size());
  for (const int count : {reasons[0], reasons[1], reasons[2], copies, turned_copies, collides}) {
    EXPECT_GT(count, 2);
  }
}

TEST(Graspability, SummarizesAtTheOptionsPercentileAndTellsZerosApart) {
  MetricOptions options;
  options.object_translation_std = 0.004;
  options.num_draws = 1;  // one try each: many are 0
  options.percentile = 90.0;
  const Graspability g = EvaluateGraspability(shapes::Sphere(1.0, 3), options, 1, 0);
  std::vector<double> qualities;
  int nonzero = 0;
  for (const ScoredGrasp& scored : g.grasps) {
    qualities.push_back(scored.quality);
    nonzero += scored.quality > 0.0 ? 1 : 0;
    EXPECT_EQ(scored.draws, 1);
  }
  std::sort(qualities.begin(), qualities.end());
  ASSERT_EQ(qualities.size(), 100u);
  EXPECT_EQ(g.value, qualities[89]);
  const Interval interval = BootstrapPercentile(qualities, 90.0);
  EXPECT_EQ(g.ci_low, interval.low);
  EXPECT_EQ(g.ci_high, interval.high);
  EXPECT_NE(g.ci_low, BootstrapPercentile(qualities, 75.0).low);
  EXPECT_DOUBLE_EQ(g.fraction_nonzero, nonzero / 100.0);
  EXPECT_GT(nonzero, 10);
  EXPECT_LT(nonzero, 90);
}

TEST(Graspability, OfAMeshThatCannotBeEvaluatedIsNaNInEveryNumber) {
  const Graspability g = EvaluateGraspability({}, {}, 1, 0);
  for (const double number : {g.value, g.ci_low, g.ci_high, g.mean, g.fraction_nonzero}) {
    EXPECT_TRUE(std::isnan(number));
  }
  EXPECT_EQ(g.attempts, 0);
  EXPECT_EQ(g.scale, 1.0);
}

}  // namespace
}  // namespace antigrasp
