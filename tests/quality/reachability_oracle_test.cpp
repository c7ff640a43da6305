#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>

#include "antigrasp/core/rng.h"
#include "tests/contact/clip_oracle.h"
#include "tests/quality/reached_object.h"
#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

struct Motion {
  Matrix3d rotation;
  Vector3d translation;
  Vector3d operator()(const Vector3d& p) const { return rotation * p + translation; }
};

Grasp Apply(const Motion& move, const Grasp& grasp) {
  Grasp moved = grasp;
  moved.center = move(grasp.center);
  moved.axis = move.rotation * grasp.axis;
  for (Contact& contact : moved.contacts) {
    contact.point = move(contact.point);
    contact.normal = move.rotation * contact.normal;
  }
  return moved;
}

// Bent and uneven, with a hole: about half of its grasps are reachable.
TriangleMesh Crooked() {
  TriangleMesh mesh = shapes::Torus(0.045, 0.018, 48, 24);
  for (Vector3d& v : mesh.vertices) v.z() += 12.0 * v.x() * v.x() - 6.0 * v.y() * v.x();
  return shapes::Joined(mesh, Moved(shapes::Box({0.02, 0.03, 0.09}), 0.05, 0.02, 0.0));
}

TEST(GripperCollision, TheAnswerMovesWithTheObject) {
  const ReachedObject object(Crooked());
  const Motion move{Eigen::AngleAxisd(2.1, Vector3d(0.3, -0.8, 0.5).normalized()).matrix(),
                    {0.2, -0.1, 0.35}};
  TriangleMesh turned = object.mesh;
  for (Vector3d& v : turned.vertices) v = move(v);
  const ReachedObject moved(turned);
  int free = 0;
  const std::vector<Grasp> grasps = SampledGrasps(object, 2000);
  ASSERT_GT(grasps.size(), 300u);
  for (const Grasp& grasp : grasps) {
    const auto here = object.FreeApproach(grasp);
    const auto there = moved.FreeApproach(Apply(move, grasp));
    ASSERT_EQ(here.has_value(), there.has_value());
    if (!here) continue;
    EXPECT_NEAR((move.rotation * *here - *there).norm(), 0.0, 1e-9);
    ++free;
  }
  EXPECT_GT(free, 50);
  EXPECT_LT(free, static_cast<int>(grasps.size()) - 50);
}

// The header's boxes, written out once more and grown by `slack` on every side, against every face.
bool TouchesSomeFace(const TriangleMesh& mesh, const GripperModel& m, const Grasp& grasp,
                     const Vector3d& approach, double slack) {
  const Vector3d across = approach.cross(grasp.axis);
  for (const auto& face : mesh.faces) {
    std::array<Vector3d, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector3d p = mesh.vertices[static_cast<std::size_t>(face[k])] - grasp.center;
      corners[k] = {p.dot(approach), p.dot(grasp.axis), p.dot(across)};
    }
    const auto touches = [&](double x0, double x1, double y0, double y1, double z) {
      const Vector3d s = Vector3d::Constant(slack);
      return ClippedTriangleRemains(corners, Vector3d(x0, y0, -z) - s, Vector3d(x1, y1, z) + s);
    };
    const double start = -m.palm_distance - m.approach_distance;
    const double outer = 0.5 * kGripperOpening + m.finger_thickness;
    if (touches(start, m.fingertip_overlap, -outer, -0.5 * kGripperOpening, 0.5 * m.finger_width) ||
        touches(start, m.fingertip_overlap, 0.5 * kGripperOpening, outer, 0.5 * m.finger_width) ||
        touches(start - m.palm_depth, -m.palm_distance, -0.5 * m.palm_length, 0.5 * m.palm_length,
                0.5 * m.palm_width)) {
      return true;
    }
  }
  return false;
}

TEST(GripperCollision, AgreesWithEveryFaceTestedOneByOneToAMicrometre) {
  // All are within the reach of the swept boxes, so that none of those can be inside unseen.
  int free = 0, blocked = 0;
  for (const TriangleMesh& mesh :
       {Crooked(), shapes::Box({0.04, 0.15, 0.06}), shapes::Torus(0.04, 0.015, 24, 12),
        shapes::Cylinder(0.02, 0.12, 24)}) {
    const GripperModel model;
    const ReachedObject object(mesh, model);
    RngStream rng(7, "angles");
    for (const Grasp& grasp : SampledGrasps(object, 150)) {
      const Vector3d side = grasp.axis.unitOrthogonal();
      for (int k = 0; k < 2; ++k) {
        const Vector3d approach =
            Eigen::AngleAxisd(rng.Uniform(0.0, 2.0 * std::numbers::pi), grasp.axis) * side;
        const bool answer = object.IsFree(grasp, approach);
        (answer ? free : blocked) += 1;
        const double slack = answer ? -1e-6 : 1e-6;  // in doubt for the answer given
        EXPECT_NE(TouchesSomeFace(mesh, model, grasp, approach, slack), answer);
      }
    }
  }
  EXPECT_GT(free, 100);
  EXPECT_GT(blocked, 100);
}

TEST(GripperCollision, ReturnsTheFirstFreeAngleAndNothingOnlyIfAllAreBlocked) {
  const GripperModel model;
  const ReachedObject object(Crooked(), model);
  int free = 0;
  for (const Grasp& grasp : SampledGrasps(object, 400)) {
    const auto approach = object.FreeApproach(grasp);
    if (approach) {
      ++free;
      EXPECT_NEAR(approach->norm(), 1.0, 1e-12);
      EXPECT_NEAR(approach->dot(grasp.axis), 0.0, 1e-12);
      EXPECT_TRUE(object.IsFree(grasp, *approach));
      continue;
    }
    const Vector3d towards = CenterOfMass(object.mesh) - grasp.center;
    const Vector3d ahead = (towards - towards.dot(grasp.axis) * grasp.axis).normalized();
    for (int i = 0; i < model.approach_angles; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / model.approach_angles;
      EXPECT_FALSE(object.IsFree(grasp, Eigen::AngleAxisd(angle, grasp.axis) * ahead));
    }
  }
  EXPECT_GT(free, 20);
}

}  // namespace
}  // namespace antigrasp
