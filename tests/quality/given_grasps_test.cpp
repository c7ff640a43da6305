// Grasps that somebody else planned: read from a table and scored.
#include "antigrasp/quality/given_grasps.h"

#include <gtest/gtest.h>

#include <cmath>

#include "antigrasp/core/error.h"
#include "antigrasp/quality/graspability.h"
#include "antigrasp/quality/robust_quality.h"
#include "tests/support/shapes.h"
#include "tests/support/temp_folder.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;
using shapes::TempFolder;

MetricOptions Few() {
  MetricOptions metric;
  metric.num_grasps = 20;
  metric.num_draws = 5;
  return metric;
}

std::vector<GivenGrasp> Read(const std::string& text) {
  const TempFolder folder;
  return ReadGivenGrasps(folder.Write("g.csv", text));
}

std::string WhyNot(const std::string& text) {
  const TempFolder folder;
  const std::string path = folder.Write("g.csv", text).string();
  try {
    ReadGivenGrasps(path);
  } catch (const InputError& error) {
    std::string what = error.what();
    const std::size_t at = what.find(path);
    return at == std::string::npos ? what : what.replace(at, path.size(), "g.csv");
  }
  return "";
}

// Every digit comes back whatever frame the table is in and wherever the object lies.
TEST(GivenGrasps, WhatWasSampledScoresTheSameToTheLastBit) {
  const TriangleMesh torus = shapes::Torus(1.0, 0.4, 24, 12);
  const TriangleMesh far = Transformed(torus, 31.7, {513.3, -88.1, 1021.9});
  for (const bool adaptive : {false, true}) {
    for (const TriangleMesh& mesh : {torus, far}) {
      for (const GraspFrame frame : {GraspFrame::kMetres, GraspFrame::kMesh}) {
        MetricOptions metric = Few();
        metric.adaptive = adaptive;
        metric.num_draws = 25;
        const Graspability sampled = EvaluateGraspability(mesh, metric, 5, 9);
        GraspTable table(frame);
        table.Add("torus", sampled, CenterOfMass(mesh));
        const std::vector<GivenScore> scores =
            ScoreGivenGrasps(mesh, Read(table.TakeText()), metric, 5, 9);
        ASSERT_EQ(scores.size(), 20U);
        for (std::size_t g = 0; g < scores.size(); ++g) {
          EXPECT_EQ(scores[g].status, "ok");
          EXPECT_EQ(scores[g].robust_quality, sampled.grasps[g].quality);
          EXPECT_EQ(scores[g].grasp.width, sampled.grasps[g].grasp.width);
          EXPECT_EQ(scores[g].grasp.approach, sampled.grasps[g].grasp.approach);
          EXPECT_EQ(scores[g].reachable, true);
        }
      }
    }
  }
}

// Other draws, another candidate's number or another object's stream: the pose of the row, to
// rounding, and other noise.
TEST(GivenGrasps, APoseThatIsNoCandidatesIsTakenAsItStands) {
  const TriangleMesh mesh = shapes::Torus(1.0, 0.4, 24, 12);
  const Graspability sampled = EvaluateGraspability(mesh, Few(), 5, 9);
  GraspTable table(GraspFrame::kMetres);
  table.Add("torus", sampled, Vector3d::Zero());
  std::vector<GivenGrasp> grasps = Read(table.TakeText());
  const auto quality = [&](std::uint64_t seed, std::uint64_t object) {
    return ScoreGivenGrasps(mesh, grasps, Few(), seed, object)[0].robust_quality;
  };
  const double own = quality(5, 9);
  EXPECT_NE(quality(6, 9), own);
  EXPECT_NE(quality(5, 8), own);
  grasps[0].candidate += 1;
  EXPECT_NE(quality(5, 9), own);
  grasps[0].candidate -= 1;
  grasps[0].center += Vector3d(1e-5, 0.0, 0.0);
  EXPECT_NE(quality(5, 9), own);
}

// A box of 40 x 60 x 80 mm, given as 1 x 1.5 x 2 somewhere; jaws open to 50 mm.
class GivenOnABox : public testing::Test {
 protected:
  GivenScore Of(const Vector3d& center, const Vector3d& axis, double width = 0.0,
                const Vector3d& approach = Vector3d::Zero()) const {
    GivenGrasp grasp;
    grasp.center = kPlace + center;
    grasp.axis = axis;
    grasp.width = width;
    grasp.approach = approach;
    return ScoreGivenGrasps(mesh_, {grasp}, Few(), 5, 9).front();
  }
  const Vector3d kPlace = {500.0, 20.0, -7.0};
  TriangleMesh mesh_ = Transformed(shapes::Box({1.0, 1.5, 2.0}), 1.0, kPlace);
  const Vector3d x_ = Vector3d::UnitX(), y_ = Vector3d::UnitY(), z_ = Vector3d::UnitZ();
};

TEST_F(GivenOnABox, ItsEpsilonIsThatOfItsContactsWithoutNoise) {
  const Vector3d center(0.1, 0.25, 0.5);  // off the middle: 10 mm along y, 20 mm along z
  const GivenScore score = Of(center, 7.0 * x_);
  EXPECT_EQ(score.status, "ok");
  EXPECT_NEAR(score.grasp.width, 0.04, 1e-12);
  const std::array<Contact, 2> contacts = {Contact{Vector3d(-0.02, 0.01, 0.02), -x_, 1.0},
                                           Contact{Vector3d(0.02, 0.01, 0.02), x_, 1.0}};
  const MetricOptions metric = Few();
  const double epsilon = Epsilon(contacts, Vector3d::Zero(), WrenchModelOf(metric, 0.5));
  EXPECT_GT(epsilon, 0.0);
  EXPECT_NEAR(score.epsilon, epsilon, 1e-9);
  EXPECT_GT(score.robust_quality, 0.0);
  EXPECT_NE(score.robust_quality, score.epsilon);
}

TEST_F(GivenOnABox, WhatDoesNotHoldAsPlannedSaysWhyAndScoresNothing) {
  const auto expect = [](const GivenScore& score, const std::string& status) {
    EXPECT_EQ(score.status, status);
    EXPECT_TRUE(score.scored());
    EXPECT_EQ(score.epsilon, 0.0) << status;
  };
  expect(Of({0.0, 2.0, 0.0}, x_), "misses");         // beside it
  expect(Of({1.2, 0.0, 0.0}, x_), "misses");         // beyond jaw 1, which meets nothing
  expect(Of({0.0, 0.0, 0.0}, z_), "starts inside");  // 80 mm deep: both, farther than they go
  expect(Of({0.6, 0.0, 0.0}, x_), "starts inside");  // jaw 1 alone
  // Tangents of 0.51 and 0.49 at friction 0.5.
  expect(Of({0.0, 0.0, 0.0}, x_ + 0.51 * y_), "slips");
  EXPECT_GT(Of({0.0, 0.0, 0.0}, x_ + 0.49 * y_).epsilon, 0.0);
}

TEST_F(GivenOnABox, WhatIsNoPoseOfTheGripperIsNotScored) {
  const double nan = std::nan("");
  EXPECT_EQ(Of({0, 0, 0}, x_, 1.24).status, "ok");
  for (const GivenScore& score : {Of({0, 0, 0}, x_, 1.26)}) EXPECT_EQ(score.status, "too wide");
  for (const GivenScore& score :
       {Of({0, nan, 0}, x_), Of({0, 0, 0}, {0, 0, 0}), Of({0, 0, 0}, {1, 0, nan}),
        Of({0, 0, 0}, x_, nan), Of({0, 0, 0}, x_, -1.0), Of({0, 0, 0}, x_, 0.0, -2.0 * x_),
        Of({0, 0, 1.0 / 0.0}, x_), Of({1e23, 0, 0}, x_), Of({0, -1e300, 0}, x_)}) {
    EXPECT_EQ(score.status, "no pose");
    EXPECT_FALSE(score.scored());
    EXPECT_FALSE(score.reachable.has_value());
  }
}

// The palm is 46 mm behind the grasp: from +y the middle is 30 mm deep, from +z 40 mm, and 60 mm
// off the middle of a large plate the gripper does not get at all.
TEST_F(GivenOnABox, IsReachedByTheApproachThatWasGivenOrByAnyOther) {
  const GivenScore by_given = Of({0, 0, 0}, x_, 0.0, {0.3, -2.0, 0.0});
  EXPECT_EQ(by_given.reachable, true);
  EXPECT_TRUE(by_given.grasp.approach.isApprox(-y_, 1e-12)) << by_given.grasp.approach;
  const GivenScore by_any = Of({0, 0, 0}, x_);
  EXPECT_EQ(by_any.reachable, true);
  EXPECT_NEAR(by_any.grasp.approach.norm(), 1.0, 1e-9);
  GivenGrasp deep;
  deep.center = Vector3d::Zero();
  deep.axis = x_;
  const TriangleMesh plate = shapes::Box({1.0, 10.0, 10.0});
  EXPECT_EQ(ScoreGivenGrasps(plate, {deep}, Few(), 5, 9)[0].reachable, false);
  MetricOptions jaws = Few();
  jaws.collision = Collision::kJaws;
  EXPECT_FALSE(ScoreGivenGrasps(plate, {deep}, jaws, 5, 9)[0].reachable.has_value());
  EXPECT_EQ(ScoreGivenGrasps(plate, {deep}, jaws, 5, 9)[0].status, "ok");
  EXPECT_EQ(ScoreGivenGrasps({}, {deep}, jaws, 5, 9)[0].status, "not evaluable");
}

TEST(GivenGraspTable, FindsItsColumnsByNameAndCountsRowsByObject) {
  const std::vector<GivenGrasp> grasps = Read(
      "note,axis_z,axis_y,axis_x,center_x,center_y,center_z,width,object,approach_x,approach_y,"
      "approach_z\n"
      "a,3,2,1,4,5,6,0.5,mug,7,8,9\n"
      "b,0,0,1,1,1,nan,,pan,,,\n"
      "c,0,0,1,,1,1,2,mug,0,0,1\n");
  ASSERT_EQ(grasps.size(), 3U);
  EXPECT_EQ(grasps[0].axis, Vector3d(1, 2, 3));
  EXPECT_EQ(grasps[0].center, Vector3d(4, 5, 6));
  EXPECT_EQ(grasps[0].approach, Vector3d(7, 8, 9));
  EXPECT_EQ(grasps[0].width, 0.5);
  EXPECT_EQ(grasps[0].object + grasps[1].object + grasps[2].object, "mugpanmug");
  EXPECT_EQ(grasps[0].id + grasps[1].id + grasps[2].id, "001");
  EXPECT_EQ(grasps[2].candidate, 1U);
  EXPECT_FALSE(grasps[2].of_a_candidate);
  EXPECT_EQ(grasps[0].frame, GraspFrame::kMesh);
  EXPECT_TRUE(std::isnan(grasps[1].center.z()));
  EXPECT_EQ(grasps[1].width, 0.0);
  EXPECT_TRUE(grasps[1].approach.isZero(0.0));
  EXPECT_TRUE(std::isnan(grasps[2].center.x()));
}

TEST(GivenGraspTable, TakesTheContactsInPlaceOfCentreAxisAndWidth) {
  const std::vector<GivenGrasp> grasps = Read(
      "p1x,p1y,p1z,p2x,p2y,p2z,grasp,candidate,frame,metres_per_unit\n"
      "1,2,3,5,2,3,g7,12,metres,0.25\n");
  EXPECT_EQ(grasps[0].center, Vector3d(3, 2, 3));
  EXPECT_EQ(grasps[0].axis, Vector3d(4, 0, 0));
  EXPECT_EQ(grasps[0].width, 4.0);
  EXPECT_EQ(grasps[0].id, "g7");
  EXPECT_EQ(grasps[0].candidate, 12U);
  EXPECT_TRUE(grasps[0].of_a_candidate);
  EXPECT_EQ(grasps[0].frame, GraspFrame::kMetres);
  EXPECT_EQ(grasps[0].metres_per_unit, 0.25);
}

TEST(GivenGraspTable, RefusesWhatItCannotReadInOneLine) {
  const std::string header = "center_x,center_y,center_z,axis_x,axis_y,axis_z";
  EXPECT_EQ(WhyNot(""), "empty table (g.csv): expected a header row and rows under it");
  EXPECT_EQ(WhyNot(header + "\n"), "no grasps (g.csv): expected a row for every grasp");
  EXPECT_EQ(WhyNot("axis_x,axis_y,axis_z\n1,0,0\n"),
            "no columns center_x center_y center_z (g.csv): expected a centre and an axis, or the "
            "contacts p1x ... p2z");
  EXPECT_EQ(WhyNot("center_x,center_y,center_z,axis_x\n1,0,0,1\n"),
            "column axis_x without axis_y axis_z (g.csv): expected all three, or none");
  EXPECT_EQ(WhyNot("center_x,center_y,center_z\n1,0,0\n"),
            "no columns axis_x axis_y axis_z (g.csv): expected a centre and an axis, or the "
            "contacts p1x ... p2z");
  for (const char* half : {"approach_x", "p2y,p2z"}) {
    EXPECT_TRUE(WhyNot(header + "," + half + "\n1,2,3,1,0,0,0,0\n").starts_with("column ")) << half;
  }
  EXPECT_EQ(WhyNot(header + ",approach_z\n1,2,3,1,0,0,-1\n"),
            "column approach_z without approach_x approach_y (g.csv): expected all three, or none");
  EXPECT_EQ(WhyNot(header + "\n1,2,3,1,0,0\n1,2,3,1,0,up\n"),
            "axis_z = \"up\" (g.csv:3): expected a number");
  EXPECT_EQ(WhyNot(header + ",frame\n1,2,3,1,0,0,inches\n"),
            "frame = inches (g.csv:2): expected metres or mesh");
  EXPECT_EQ(WhyNot(header + ",candidate\n1,2,3,1,0,0,1.5\n"),
            "candidate = 1.5 (g.csv:2): expected a whole number");
  EXPECT_EQ(WhyNot(header + ",metres_per_unit\n1,2,3,1,0,0,0.1\n"),
            "no column frame (g.csv): expected frame (mesh or metres), as evaluate --grasps writes "
            "it since it says so");
}

}  // namespace
}  // namespace antigrasp
