// The commands evaluate and quality: every column of their tables by name, against the library.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/datasets/object_names.h"
#include "antigrasp/mesh/mesh_file.h"
#include "antigrasp/mesh/repair.h"
#include "antigrasp/quality/graspability.h"
#include "tests/app/run_binary.h"
#include "tests/support/csv_rows.h"
#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

namespace fs = std::filesystem;
using cli::Antigrasp;
using cli::ExpectRefused;
using cli::Outcome;
using cli::Shell;
using shapes::CsvRows;
using shapes::TempFolder;

using Cells = std::map<std::string, std::string>;

double Number(const Cells& row, const std::string& name) { return std::stod(row.at(name)); }

Eigen::Vector3d Vector(const Cells& row, const std::string& head, const std::string& joint = "") {
  return {Number(row, head + joint + "x"), Number(row, head + joint + "y"),
          Number(row, head + joint + "z")};
}

// A box far from the origin: what belongs to the object and what to its frame differ.
void WriteMovedBox(const fs::path& path) {
  WriteMesh(path, Transformed(shapes::Box({1.0, 1.5, 2.0}), 1.0, {5.0, 5.0, 5.0}));
}

// As evaluate reads and scores it.
Graspability Scored(const fs::path& path, const MetricOptions& metric, std::uint64_t seed) {
  return EvaluateGraspability(Repair(ReadMesh(path)).mesh, metric, seed,
                              StreamOf(path.filename().string()));
}

// popen's own redirection must not take it: the command's standard output is the device.
TEST(EvaluateCli, ATableThatStandardOutputCannotTakeIsAnError) {
  if (::access("/dev/full", W_OK) != 0) GTEST_SKIP() << "no /dev/full";
  const Outcome outcome = Shell("{ " + std::string(ANTIGRASP_BINARY) + " gripper > /dev/full; }");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_NE(outcome.text.find("cannot write to standard output"), std::string::npos)
      << outcome.text;
}

TEST(EvaluateCli, AJudgeWithoutANameIsRefused) {
  ExpectRefused("evaluate nothing.stl --judge ''", "expected epsilon, settled, trial");
}

TEST(EvaluateCli, WritesEveryNumberOfAScoreUnderItsOwnName) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/";
  fs::create_directory(folder / "in");
  WriteMovedBox(folder / "in/a.stl");
  WriteMesh(folder / "in/b.stl", shapes::Torus(1.0, 0.4, 24, 12));
  const Outcome outcome =
      Antigrasp("evaluate " + dir + "in --seed 5 --num-grasps 12 --num-draws 3" +
                " --friction 0.3 --out " + dir + "s.csv");
  ASSERT_EQ(outcome.code, 0) << outcome.text;
  MetricOptions metric;
  metric.num_grasps = 12;
  metric.num_draws = 3;
  metric.friction = 0.3;
  const auto rows = CsvRows(folder / "s.csv");
  ASSERT_EQ(rows.size(), 2U);
  double attempts = 0, slips = 0, blocked = 0, collides = 0, open = 0;
  int copies = 0;
  for (std::size_t i = 0; i < 2; ++i) {
    const std::string name = i == 0 ? "a.stl" : "b.stl";
    const Graspability score = Scored(folder / "in" / name, metric, 5);
    EXPECT_EQ(rows[i].at("object"), name);
    EXPECT_EQ(rows[i].at("status"), "ok");
    EXPECT_EQ(rows[i].at("num_grasps"), "12");
    EXPECT_EQ(Number(rows[i], "graspability"), score.value);
    EXPECT_EQ(Number(rows[i], "ci_low"), score.ci_low);
    EXPECT_EQ(Number(rows[i], "ci_high"), score.ci_high);
    EXPECT_LE(score.ci_low, score.value);
    EXPECT_LT(score.ci_low, score.ci_high);
    EXPECT_EQ(Number(rows[i], "mean"), score.mean);
    EXPECT_LT(score.mean, score.value);
    EXPECT_EQ(Number(rows[i], "fraction_nonzero"), score.fraction_nonzero);
    EXPECT_GE(Number(rows[i], "seconds"), 0.0);
    attempts += score.attempts;
    open += score.rejected.Of("nothing within the opening");
    slips += score.rejected.Of("slip");
    blocked += score.rejected.Of("jaw blocked");
    collides += score.rejected.Of("gripper collides");
    copies += score.rejected.copies;
  }
  char line[256];
  std::snprintf(line, sizeof line,
                "%.0f candidate grasps: %.0f %% kept, %.0f %% nothing within the opening, %.0f %% "
                "slip, %.0f %% jaw blocked, %.0f %% gripper collides, %d copies\n",
                attempts, 2400.0 / attempts, 100.0 * open / attempts, 100.0 * slips / attempts,
                100.0 * blocked / attempts, 100.0 * collides / attempts, copies);
  EXPECT_NE(outcome.text.find(line), std::string::npos) << line << outcome.text;
}

TEST(EvaluateCli, WritesGraspsWhoseColumnsSayWhatTheyHold) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/";
  WriteMovedBox(folder / "box.stl");
  ASSERT_EQ(Antigrasp("evaluate " + dir + "box.stl --seed 5 --num-grasps 12 --num-draws 3" +
                      " --grasps " + dir + "g.csv --out " + dir + "s.csv")
                .code,
            0);
  MetricOptions metric;
  metric.num_grasps = 12;
  metric.num_draws = 3;
  const Graspability score = Scored(folder / "box.stl", metric, 5);
  const auto rows = CsvRows(folder / "g.csv");
  ASSERT_EQ(rows.size(), 12U);
  for (std::size_t g = 0; g < rows.size(); ++g) {
    const Cells& row = rows[g];
    const ScoredGrasp& expected = score.grasps[g];
    EXPECT_EQ(row.at("object"), "box.stl");
    EXPECT_EQ(row.at("grasp"), std::to_string(g));
    const Eigen::Vector3d p1 = Vector(row, "p1"), p2 = Vector(row, "p2"), n1 = Vector(row, "n1"),
                          n2 = Vector(row, "n2"), axis = Vector(row, "axis", "_"),
                          approach = Vector(row, "approach", "_"), com = Vector(row, "com");
    EXPECT_EQ(p1, expected.grasp.contacts[0].point);
    EXPECT_EQ(n1, expected.grasp.contacts[0].normal);
    EXPECT_EQ(p2, expected.grasp.contacts[1].point);
    EXPECT_EQ(n2, expected.grasp.contacts[1].normal);
    EXPECT_EQ(axis, expected.grasp.axis);
    EXPECT_EQ(approach, expected.grasp.approach);
    EXPECT_EQ(Number(row, "width"), expected.grasp.width);
    EXPECT_EQ(Number(row, "robust_quality"), expected.quality);
    // The shortest side of 1 is 4 cm.
    EXPECT_LT((com - Eigen::Vector3d::Constant(0.2)).norm(), 1e-6);
    EXPECT_TRUE(((p1 - com).array().abs() <= Eigen::Array3d(0.02, 0.03, 0.04) + 1e-6).all());
    EXPECT_NEAR((p2 - p1).norm(), Number(row, "width"), 1e-9);
    EXPECT_LT(((p2 - p1).normalized() - axis).norm(), 1e-9);
    EXPECT_LT(n1.dot(axis), 0.0);  // outward, and the jaw comes along the axis
    EXPECT_GT(n2.dot(axis), 0.0);
    EXPECT_NEAR(approach.norm(), 1.0, 1e-9);
    EXPECT_NEAR(approach.dot(axis), 0.0, 1e-9);
    EXPECT_EQ(Vector(row, "in1"), axis);
    EXPECT_EQ(Vector(row, "in2"), Eigen::Vector3d(-axis));
  }
}

// The face of the box that a contact with this normal lies on, seen along the normal.
double FaceAlong(const Eigen::Vector3d& normal, const BoundingBox& box) {
  double along = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    along += normal[axis] * (normal[axis] > 0.0 ? box.max : box.min)[axis];
  }
  return along;
}

TEST(EvaluateCli, WritesGraspsInTheFrameOfTheInput) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/";
  // 90.7 mm wide, somewhere on a table.
  const TriangleMesh mesh = Transformed(shapes::Box({1.0, 1.5, 2.0}), 90.7, {513.7, -88.3, 1021.9});
  WriteMesh(folder / "box.obj", mesh);
  const BoundingBox box = Bounds(ReadMesh(folder / "box.obj"));
  const std::string evaluate = "evaluate " + dir + "box.obj --num-grasps 12 --num-draws 2 --out " +
                               dir + "s.csv --grasps " + dir;
  ASSERT_EQ(Antigrasp(evaluate + "metres.csv").code, 0);
  ASSERT_EQ(Antigrasp(evaluate + "mesh.csv --frame mesh").code, 0);
  const auto metres = CsvRows(folder / "metres.csv"), rows = CsvRows(folder / "mesh.csv");
  ASSERT_EQ(rows.size(), 12U);
  ASSERT_EQ(metres.size(), 12U);
  const double size = 1021.9;
  for (std::size_t g = 0; g < rows.size(); ++g) {
    const double scale = Number(metres[g], "metres_per_unit");
    EXPECT_NEAR(scale, 0.04 / 90.7, 1e-15);
    EXPECT_EQ(Number(rows[g], "metres_per_unit"), scale);
    for (const char* contact : {"1", "2"}) {
      const Eigen::Vector3d point = Vector(rows[g], std::string("p") + contact);
      const Eigen::Vector3d normal = Vector(rows[g], std::string("n") + contact);
      EXPECT_NEAR(normal.cwiseAbs().maxCoeff(), 1.0, 1e-12);
      EXPECT_NEAR(point.dot(normal), FaceAlong(normal, box), 1e-12 * size);
      EXPECT_TRUE((point.array() >= box.min.array() - 1e-12 * size).all());
      EXPECT_TRUE((point.array() <= box.max.array() + 1e-12 * size).all());
      // What the table in metres says is the same point.
      EXPECT_LT((Vector(metres[g], std::string("p") + contact) / scale - point).norm(),
                1e-12 * size);
      EXPECT_EQ(Vector(metres[g], std::string("n") + contact), normal);
    }
    EXPECT_NEAR((Vector(rows[g], "p2") - Vector(rows[g], "p1")).norm(), Number(rows[g], "width"),
                1e-12 * size);
    EXPECT_LT((Vector(rows[g], "com") - (box.min + box.max) / 2.0).norm(), 1e-12 * size);
    EXPECT_LT((Vector(metres[g], "com") / scale - Vector(rows[g], "com")).norm(), 1e-12 * size);
    EXPECT_EQ(rows[g].at("robust_quality"), metres[g].at("robust_quality"));
  }
  cli::ExpectRefused("evaluate " + dir + "box.obj --frame mesh", "--frame requires --grasps");
  cli::ExpectRefused("evaluate " + dir + "box.obj --grasps " + dir + "g.csv --frame inches",
                     "--frame");
}

TEST(QualityCli, FindsTheEpsilonOfEveryGraspThatEvaluateWritesWhereverTheObjectLies) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/";
  WriteMovedBox(folder / "box.stl");
  // Without noise and with one draw the robust quality of a grasp is its epsilon.
  ASSERT_EQ(Antigrasp("evaluate " + dir + "box.stl --noise none --num-draws 1 --num-grasps 8" +
                      " --grasps " + dir + "g.csv --out " + dir + "s.csv")
                .code,
            0);
  ASSERT_EQ(Antigrasp("quality " + dir + "g.csv --out " + dir + "q.csv").code, 0);
  const auto grasps = CsvRows(folder / "g.csv"), qualities = CsvRows(folder / "q.csv");
  ASSERT_EQ(grasps.size(), 8U);
  ASSERT_EQ(qualities.size(), 8U);
  for (std::size_t i = 0; i < 8; ++i) {
    const double robust = Number(grasps[i], "robust_quality");
    EXPECT_GT(robust, 0.0);
    EXPECT_EQ(qualities[i].at("id"), std::to_string(i + 1));
    EXPECT_NEAR(Number(qualities[i], "epsilon"), robust, 1e-9 * robust);
  }
}

TEST(QualityCli, TellsItsColumnsApart) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/";
  // Jaws on both sides; normals that point inward close only where signs do not count; normals
  // along the jaws' faces hold nothing. A torque of 0.25 is resisted, one of 1000 is not.
  folder.Write("c.csv",
               "id,p1x,p1y,p1z,n1x,n1y,n1z,p2x,p2y,p2z,n2x,n2y,n2z,comx,comy,comz,wfx,wfy,wfz\n"
               "heavy,-0.02,0,0,-1,0,0,0.02,0,0,1,0,0,0,0,0,0,0,1000\n"
               "inward,-0.02,0,0,1,0,0,0.02,0,0,-1,0,0,0,0,0,0,0,0.25\n"
               "along,-0.02,0,0,0,1,0,0.02,0,0,0,1,0,0,0,0,0,0,0.25\n");
  const Outcome outcome = Antigrasp("quality " + dir + "c.csv --out " + dir + "q.csv");
  ASSERT_EQ(outcome.code, 0) << outcome.text;
  EXPECT_NE(outcome.text.find("3 grasps: 2 with epsilon > 0, 1 in force closure, 1 of 3 wrenches"),
            std::string::npos)
      << outcome.text;
  const auto rows = CsvRows(folder / "q.csv");
  ASSERT_EQ(rows.size(), 3U);
  const auto expect = [&](std::size_t i, const std::string& id, const std::string& closure,
                          const std::string& signed_closure, const std::string& resisted) {
    EXPECT_EQ(rows[i].at("id"), id);
    EXPECT_EQ(rows[i].at("force_closure"), closure) << id;
    EXPECT_EQ(rows[i].at("force_closure_signed"), signed_closure) << id;
    EXPECT_EQ(rows[i].at("wrench_resisted"), resisted) << id;
    EXPECT_EQ(Number(rows[i], "wrench_resistance") > 1.0, resisted == "1") << id;
    EXPECT_EQ(Number(rows[i], "epsilon") > 0.0, closure == "1") << id;
  };
  expect(0, "heavy", "1", "1", "0");
  expect(1, "inward", "1", "0", "1");
  expect(2, "along", "0", "0", "0");
}

TEST(EvaluateCli, TakesTheBaselineFromTheOriginalOfTheSameName) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/";
  for (const char* set : {"before", "after"}) fs::create_directory(folder / set);
  // Only the second object changes, for the worse, but not to nothing.
  WriteMesh(folder / "before/a.stl", shapes::Cylinder(1.0, 3.0, 24));
  WriteMesh(folder / "after/a.stl", shapes::Cylinder(1.0, 3.0, 24));
  WriteMesh(folder / "before/b.stl", shapes::Cube());
  WriteMesh(folder / "after/b.stl", shapes::Torus(1.0, 0.4, 24, 12));
  // The third has no score any more: it is no pair, and its original is not of the baseline's mean.
  WriteMesh(folder / "before/c.stl", shapes::Box({1.0, 1.5, 2.0}));
  WriteMesh(folder / "after/c.stl", shapes::FlatSquare());
  const Outcome outcome = Antigrasp(
      "evaluate " + dir + "after --baseline " + dir + "before/b.stl " + dir + "before/a.stl " +
      dir + "before/c.stl --seed 5 --num-grasps 12 --num-draws 3 --out " + dir + "s.csv");
  ASSERT_EQ(outcome.code, 0) << outcome.text;
  MetricOptions metric;
  metric.num_grasps = 12;
  metric.num_draws = 3;
  const double a = Scored(folder / "before/a.stl", metric, 5).value,
               b = Scored(folder / "before/b.stl", metric, 5).value,
               changed = Scored(folder / "after/b.stl", metric, 5).value;
  ASSERT_GT(changed, 0.0);
  ASSERT_LT(changed, 0.9 * b);
  ASSERT_NE(a, b);
  ASSERT_GT(Scored(folder / "before/c.stl", metric, 5).value, 0.0);
  const auto rows = CsvRows(folder / "s.csv");
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[0].at("object"), "a.stl");
  EXPECT_EQ(Number(rows[0], "baseline"), a);
  EXPECT_EQ(Number(rows[0], "difference"), 0.0);
  EXPECT_EQ(Number(rows[1], "graspability"), changed);
  EXPECT_EQ(Number(rows[1], "baseline"), b);
  EXPECT_EQ(Number(rows[1], "difference"), changed - b);
  // The mean of (0, d) is d / 2, and its 95 % interval 1.96 d / sqrt(2) / sqrt(2).
  const double mean = 0.5 * (changed - b), baseline = 0.5 * (a + b);
  const double half_width = 1.959964 * (b - changed) / 2.0;
  char text[200];
  std::snprintf(text, sizeof text,
                "paired difference %+.5f +-%.5f (95 %%), %+.1f +-%.1f %% of the baseline's %.5f, "
                "2 pairs\n",
                mean, half_width, 100.0 * mean / baseline, 100.0 * half_width / baseline, baseline);
  EXPECT_NE(outcome.text.find(text), std::string::npos) << text << outcome.text;
}

TEST(EvaluateCli, RefusesASetInWhichNothingHasAScoreAndWritesNothing) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/";
  fs::create_directory(folder / "in");
  WriteMesh(folder / "in/a.stl", shapes::FlatSquare());
  WriteMesh(folder / "in/b.stl", shapes::FlatSquare());
  const Outcome outcome =
      Antigrasp("evaluate " + dir + "in --grasps " + dir + "g.csv --out " + dir + "s.csv");
  EXPECT_EQ(outcome.code, 2) << outcome.text;
  EXPECT_NE(outcome.text.find("antigrasp: no object scored; a.stl: open"), std::string::npos)
      << outcome.text;
  EXPECT_NE(outcome.text.find("(" + dir + "in): expected a closed solid\n"), std::string::npos)
      << outcome.text;
  EXPECT_EQ(outcome.text.find("nan"), std::string::npos) << outcome.text;
  for (const char* name : {"s.csv", "g.csv", "s.csv.metric.toml"}) {
    EXPECT_FALSE(fs::exists(folder / name)) << name;
  }
}

TEST(EvaluateCli, SaysThatNoPairHasTwoScoresOrThatTheBaselineIsZeroWithoutANumber) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/";
  WriteMesh(folder / "cube.stl", shapes::Cube());
  WriteMesh(folder / "open.stl", shapes::FlatSquare());
  const std::string common = "evaluate " + dir + "cube.stl --num-grasps 5 --num-draws 1 --out " +
                             dir + "s.csv --baseline ";
  const Outcome none = Antigrasp(common + dir + "open.stl");
  EXPECT_EQ(none.code, 0) << none.text;
  EXPECT_NE(none.text.find("no paired difference: "), std::string::npos) << none.text;
  EXPECT_EQ(none.text.find("nan"), std::string::npos) << none.text;
  const Outcome zero = Antigrasp(common + dir + "cube.stl --torsion none");
  EXPECT_EQ(zero.code, 0) << zero.text;
  EXPECT_NE(zero.text.find("paired difference +0.00000, 95 % interval over its grasps +0.00000 to "
                           "+0.00000, the baseline is 0, 1 pairs\n"),
            std::string::npos)
      << zero.text;
  EXPECT_EQ(zero.text.find("nan"), std::string::npos) << zero.text;
}

// The flag of an option, as docs/metric.md writes it.
std::string Flag(const std::string& key) {
  std::string flag = key.starts_with("metric.") ? key.substr(7) : key;
  for (char& c : flag) c = c == '_' || c == '.' ? '-' : c;
  return "--" + flag;
}

TEST(EvaluateCli, EveryFlagOfTheMetricSetsItsOwnConstant) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/";
  WriteMesh(folder / "cube.stl", shapes::Cube());
  MetricOptions defaults, read;
  OptionTable table, of_read;
  Bind(&table, &defaults);
  Bind(&of_read, &read);
  std::map<std::string, std::string> given;
  std::string flags;
  for (const Option& option : table.options()) {
    if (auto* const number = std::get_if<double*>(&option.target)) {
      **number = option.min + 0.9 * (**number - option.min) + 1e-4 * double(given.size() + 1);
    } else if (auto* const whole = std::get_if<int*>(&option.target)) {
      **whole += static_cast<int>(given.size()) + 1;
    } else if (auto* const choice = std::get_if<Option::Enum>(&option.target)) {
      choice->set(choice->value, option.choices.size() - 1);
    } else {
      flags += " " + Flag(option.key);
      given[option.key] = "true";
      continue;
    }
    std::string value = ValueText(option);
    std::erase(value, '"');
    flags += " " + Flag(option.key) + " " + value;
    given[option.key] = value;
  }
  const Outcome outcome = Antigrasp("evaluate " + dir + "cube.stl --seed 77 --out " + dir +
                                    "s.csv --preset egad --noise dexnet" + flags);
  ASSERT_EQ(outcome.code, 0) << outcome.text;
  const std::string toml = ReadFile(folder / "s.csv.metric.toml");
  EXPECT_NE(toml.find("seed = 77"), std::string::npos) << toml;
  of_read.ApplyKnown(toml, "s.csv.metric.toml", "metric.");
  for (const Option& option : of_read.options()) {
    std::string value = ValueText(option);
    std::erase(value, '"');
    EXPECT_EQ(value, given[option.key]) << option.key;
  }
}

}  // namespace
}  // namespace antigrasp
