// The table of `antigrasp poses`, of a box whose poses are known on paper.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <Eigen/LU>
#include <cmath>
#include <map>
#include <numbers>
#include <sstream>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/mesh/mesh_file.h"
#include "tests/app/run_binary.h"
#include "tests/support/shapes.h"
#include "tests/support/temp_folder.h"

namespace antigrasp {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Neither symmetric nor sparse: a transposed rotation is another one.
Matrix3d Turn() {
  Matrix3d turn;
  turn << 2.0, 3.0, 6.0, 6.0, 2.0, -3.0, -3.0, 6.0, -2.0;
  return turn / 7.0;
}

std::vector<std::map<std::string, double>> PosesIn(const std::string& csv) {
  std::istringstream lines(csv);
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, "object,pose,probability,com_height,r00,r01,r02,r10,r11,r12,r20,r21,r22");
  const std::vector<std::string> names = {"pose", "probability", "com_height", "r00", "r01", "r02",
                                          "r10",  "r11",         "r12",        "r20", "r21", "r22"};
  std::vector<std::map<std::string, double>> poses;
  while (std::getline(lines, line)) {
    std::istringstream fields(line);
    std::string field;
    std::getline(fields, field, ',');
    EXPECT_EQ(field, "box.stl");
    auto& pose = poses.emplace_back();
    for (const std::string& name : names) {
      std::getline(fields, field, ',');
      pose[name] = std::stod(field);
    }
  }
  return poses;
}

// The solid angle of a face w x h seen from distance d on its axis, as a share of the sphere: so
// often the face is met, and a box does not roll off it.
double ShareOfFace(double w, double h, double d) {
  return std::atan(w * h / (2.0 * d * std::sqrt(4.0 * d * d + w * w + h * h))) / std::numbers::pi;
}

TEST(PosesCli, SaysWhatOfAMeshItLeftOut) {
  const shapes::TempFolder folder;
  const std::string solid =
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
  const auto whole = folder.Write("whole.obj", solid),
             edge = folder.Write("edge.obj", solid + "f 1 2\n");
  const std::string out = (folder / "p.csv").string();
  EXPECT_EQ(cli::Antigrasp("poses " + whole.string() + " --out " + out).text.find("left out"),
            std::string::npos);
  const std::string poses = ReadFile(out);
  const cli::Outcome outcome = cli::Antigrasp("poses " + edge.string() + " --out " + out);
  EXPECT_EQ(outcome.code, 0) << outcome.text;
  EXPECT_NE(outcome.text.find("edge.obj: 1 face of fewer than 3 corners left out (face 5 has 2 "
                              "corners)\n"),
            std::string::npos)
      << outcome.text;
  std::string named = ReadFile(out);
  for (std::size_t at; (at = named.find("edge.obj")) != std::string::npos;) {
    named.replace(at, 8, "whole.obj");
  }
  EXPECT_EQ(named, poses);
}

// A box of 2 x 3 x 4 away from the origin lies on its six faces: on 3 x 4 the centre of mass is 1
// above the table, on 2 x 4 it is 1.5, on 2 x 3 it is 2.
TEST(PosesCli, EveryColumnHoldsWhatItsNameSays) {
  const shapes::TempFolder folder;
  const Vector3d extent(2.0, 3.0, 4.0), away(10.0, -20.0, 30.0);
  const Matrix3d turn = Turn();
  ASSERT_NEAR((turn * turn.transpose() - Matrix3d::Identity()).norm(), 0.0, 1e-12);
  WriteMesh(folder / "box.stl", Transformed(shapes::Rotated(shapes::Box(extent), turn), 1.0, away));
  const cli::Outcome outcome = cli::Antigrasp("poses " + (folder / "box.stl").string() + " --out " +
                                              (folder / "p.csv").string());
  ASSERT_EQ(outcome.code, 0) << outcome.text;
  auto poses = PosesIn(ReadFile(folder / "p.csv"));
  ASSERT_EQ(poses.size(), 6u);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    auto& pose = poses[i];
    EXPECT_EQ(pose["pose"], double(i));
    const auto axis = static_cast<int>(i / 2);  // likeliest first: lowest first
    EXPECT_NEAR(pose["com_height"], 0.5 * extent[axis], 1e-5);
    const double w = extent[(axis + 1) % 3], h = extent[(axis + 2) % 3];
    EXPECT_NEAR(pose["probability"], ShareOfFace(w, h, 0.5 * extent[axis]), 1e-5);
    Matrix3d r;
    r << pose["r00"], pose["r01"], pose["r02"], pose["r10"], pose["r11"], pose["r12"], pose["r20"],
        pose["r21"], pose["r22"];
    // The third row is "up" in the object's frame, here along an axis of the box.
    EXPECT_NEAR(std::abs(r.row(2).dot(turn.col(axis))), 1.0, 1e-6);
    EXPECT_NEAR(pose["r02"], 0.0, 1e-9);  // row 0 lies in the object's xy plane
    EXPECT_NEAR((r * r.transpose() - Matrix3d::Identity()).norm(), 0.0, 1e-9);
    EXPECT_NEAR(r.determinant(), 1.0, 1e-9);
  }
}

}  // namespace
}  // namespace antigrasp
