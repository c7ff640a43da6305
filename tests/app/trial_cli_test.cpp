// The table of `antigrasp trial`, where its numbers are known on paper or tied to each other.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <sstream>

#include "antigrasp/core/angles.h"
#include "antigrasp/core/atomic_file.h"
#include "antigrasp/mesh/mesh_file.h"
#include "tests/app/run_binary.h"
#include "tests/support/shapes.h"
#include "tests/support/temp_folder.h"

namespace antigrasp {
namespace {

using Numbers = std::map<std::string, std::map<std::string, double>>;

constexpr double kZ2 = 1.959963984540054 * 1.959963984540054;  // of Wilson's interval

// Rows by object and reading, "cube.stl full-cone"; every other field is a number.
Numbers Trial(const std::string& arguments) {
  const shapes::TempFolder folder;
  WriteMesh(folder / "cube.stl", shapes::Box({30.0, 30.0, 30.0}));
  const cli::Outcome outcome = cli::Antigrasp(
      "trial --engine model " + (folder / "cube.stl").string() + " --mm --noise none --series 3 " +
      "--grasps-per-series 4 --executions 2 --num-draws 1 --out " + (folder / "t.csv").string() +
      " " + arguments);
  EXPECT_EQ(outcome.code, 0) << outcome.text;
  std::istringstream lines(ReadFile(folder / "t.csv"));
  std::string line, name, field;
  std::getline(lines, line);
  EXPECT_EQ(line,
            "object,reading,friction,poses,grasps,found,holds_planned,confidence,force_closure,"
            "force_closure_low,force_closure_high,held,held_low,held_high");
  std::istringstream names(line.substr(std::string("object,reading,").size()));
  std::vector<std::string> header;
  while (std::getline(names, name, ',')) header.push_back(name);
  Numbers rows;
  while (std::getline(lines, line)) {
    std::istringstream fields(line);
    std::string object, reading;
    std::getline(fields, object, ',');
    std::getline(fields, reading, ',');
    for (const std::string& column : header) {
      std::getline(fields, field, ',');
      rows[object + " " + reading][column] = std::stod(field);
    }
  }
  return rows;
}

// Without noise an execution is as planned: force closure where a grasp was found, held where it
// holds as planned. A cube of 30 mm has grasps at its corners that close and have no epsilon.
TEST(TrialTableCli, EveryColumnHoldsWhatItsNameSays) {
  Numbers rows = Trial("--min-epsilon 0 --num-grasps 8 --seed 3");
  ASSERT_EQ(rows.size(), 2u);
  auto& half = rows["cube.stl half-angle"];
  EXPECT_NEAR(half["friction"], std::tan(17.0 * kDegree), 1e-15);
  EXPECT_NEAR(rows["cube.stl full-cone"]["friction"], std::tan(8.5 * kDegree), 1e-15);
  EXPECT_EQ(half["poses"], 6.0);
  EXPECT_EQ(half["grasps"], 12.0);           // 3 series of 4
  EXPECT_GT(half["grasps"], half["found"]);  // so that no two are equal
  EXPECT_GT(half["found"], half["holds_planned"]);
  EXPECT_GT(half["holds_planned"], half["poses"]);
  EXPECT_EQ(half["force_closure"], half["found"] / 12.0);
  EXPECT_EQ(half["held"], half["holds_planned"] / 12.0);
  for (const std::string share : {"force_closure", "held"}) {
    EXPECT_LT(half[share + "_low"], half[share]) << share;
    EXPECT_GT(half[share + "_high"], half[share]) << share;
  }
  EXPECT_GT(half["confidence"], 0.0);
  EXPECT_LT(half["confidence"], 0.01);  // a robust quality
}

// All series alike: Wilson's interval of as many executions as there are series, 3. Of none it is
// [0, z^2 / (3 + z^2)], of all [3 / (3 + z^2), 1].
TEST(TrialTableCli, SharesOfNoneAndAllHaveTheirIntervals) {
  Numbers rows = Trial("--min-epsilon 1000 --num-grasps 40 --reading full-cone");
  ASSERT_EQ(rows.size(), 1u);
  auto& row = rows["cube.stl full-cone"];
  EXPECT_EQ(row["found"], 12.0);
  EXPECT_EQ(row["holds_planned"], 0.0);
  EXPECT_EQ(row["force_closure"], 1.0);
  EXPECT_NEAR(row["force_closure_low"], 3.0 / (3.0 + kZ2), 1e-9);
  EXPECT_EQ(row["force_closure_high"], 1.0);
  EXPECT_EQ(row["held"], 0.0);
  EXPECT_NEAR(row["held_low"], 0.0, 1e-9);
  EXPECT_NEAR(row["held_high"], kZ2 / (3.0 + kZ2), 1e-9);
}

}  // namespace
}  // namespace antigrasp
