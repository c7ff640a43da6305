// --gripper and the command gripper: names, files, what wins over what, and the document's table.
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <sstream>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/mesh/inspect.h"
#include "antigrasp/mesh/mesh_file.h"
#include "antigrasp/quality/named_gripper.h"
#include "tests/app/run_binary.h"
#include "tests/support/shapes.h"
#include "tests/support/temp_folder.h"

namespace antigrasp {
namespace {

namespace fs = std::filesystem;
using cli::Antigrasp;
using cli::ExpectRefused;
using cli::Outcome;
using shapes::TempFolder;

const std::string kExample = std::string(ANTIGRASP_CONFIGS) + "/gripper_example.toml";
const std::string kFiveGrasps = " --num-grasps 5 --num-draws 2 ";

bool Holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

// The constants that evaluate writes beside its table.
std::string MetricOf(const std::string& flags, const TempFolder& folder) {
  const std::string dir = folder.path().string() + "/";
  const Outcome outcome =
      Antigrasp("evaluate " + dir + "box.stl --out " + dir + "s.csv " + flags + kFiveGrasps);
  EXPECT_EQ(outcome.code, 0) << outcome.text;
  return ReadFile(folder / "s.csv.metric.toml");
}

TEST(GripperCli, WhatItPrintsIsAFileThatEvaluateTakesForTheName) {
  const TempFolder folder;
  WriteMesh(folder / "box.stl", shapes::Box({1.0, 1.5, 2.0}));
  const Outcome printed = Antigrasp("gripper robotiq_85");
  ASSERT_EQ(printed.code, 0) << printed.text;
  const std::string mine = folder.Write("mine.toml", printed.text).string();
  const std::string by_name = MetricOf("--gripper robotiq_85", folder);
  EXPECT_EQ(MetricOf("--gripper " + mine, folder), by_name);
  EXPECT_TRUE(Holds(by_name, "jaw_opening = 0.085 ")) << by_name;
  EXPECT_TRUE(Holds(by_name, "palm_length = 0.1484 ")) << by_name;
  EXPECT_EQ(MetricOf("--gripper yumi", folder), MetricOf("", folder));
}

TEST(GripperCli, ASingleOptionWinsWhereverItStands) {
  const TempFolder folder;
  WriteMesh(folder / "box.stl", shapes::Box({1.0, 1.5, 2.0}));
  const std::string behind = MetricOf("--gripper panda --jaw-opening 0.06", folder);
  EXPECT_EQ(MetricOf("--jaw-opening 0.06 --gripper panda", folder), behind);
  EXPECT_TRUE(Holds(behind, "jaw_opening = 0.06 ")) << behind;
  EXPECT_TRUE(Holds(behind, "palm_length = 0.2044 ")) << behind;
  // A preset is everything: the gripper wins over its opening and leaves the rest of it.
  const std::string preset = MetricOf("--gripper panda --preset egad", folder);
  EXPECT_TRUE(Holds(preset, "jaw_opening = 0.08 ")) << preset;
  EXPECT_TRUE(Holds(preset, "torque_scale = 100.0 ")) << preset;
}

TEST(GripperCli, EveryCommandThatHasAMetricTakesIt) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/", box = dir + "box.stl ";
  WriteMesh(folder / "box.stl", shapes::Box({1.0, 1.5, 2.0}));
  const std::string flags = "--gripper robotiq_140" + kFiveGrasps + "--out " + dir;
  Outcome outcome = Antigrasp("perturb random " + box + "--iterations 1 " + flags + "p");
  EXPECT_EQ(outcome.code, 0) << outcome.text;
  EXPECT_TRUE(Holds(ReadFile(folder / "p/perturb.toml"), "jaw_opening = 0.14 "));
  outcome =
      Antigrasp("trial --engine model " + box + "--series 1 --executions 1 " + flags + "t.csv");
  EXPECT_EQ(outcome.code, 0) << outcome.text;
  EXPECT_TRUE(Holds(ReadFile(folder / "t.csv.trial.toml"), "jaw_opening = 0.14 "));
  for (const char* command : {"train", "report", "evaluate", "trial", "perturb search"}) {
    EXPECT_TRUE(Holds(Antigrasp(std::string(command) + " --help").text, "--gripper NAME|FILE"))
        << command;
  }
}

TEST(GripperCli, ListsTheKnownOnesAndWritesOneAsItsExtensionSays) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/";
  const Outcome list = Antigrasp("gripper");
  EXPECT_EQ(list.code, 0);
  for (const NamedGripper& gripper : NamedGrippers()) {
    EXPECT_TRUE(Holds(list.text, std::string(gripper.name))) << list.text;
  }
  ASSERT_EQ(Antigrasp("gripper panda --out " + dir + "g.stl").code, 0);
  const TriangleMesh mesh = ReadMesh(folder / "g.stl");
  EXPECT_TRUE(Inspect(mesh).closed);
  EXPECT_NEAR(Bounds(mesh).Extent().y(), 204.4, 1e-3);            // the palm, millimetres
  EXPECT_NEAR(Bounds(mesh).Extent().x(), 66 + 37.4 + 9.5, 1e-3);  // flange to fingertips
  ASSERT_EQ(Antigrasp("gripper panda --out " + dir + "g.png").code, 0);
  EXPECT_EQ(ReadFile(folder / "g.png").substr(1, 3), "PNG");
  ASSERT_EQ(Antigrasp("gripper panda --out " + dir + "g.toml").code, 0);
  EXPECT_EQ(ReadFile(folder / "g.toml"), Antigrasp("gripper panda").text);
}

TEST(GripperCli, RefusesInOneLine) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/", box = dir + "box.stl";
  WriteMesh(folder / "box.stl", shapes::Box({1.0, 1.5, 2.0}));
  folder.Write("mine.toml", Antigrasp("gripper panda").text);
  const std::string mine = dir + "mine.toml", written_over = "would be written over a file";
  ExpectRefused("evaluate " + box + " --gripper " + mine + " --out " + mine, written_over);
  ExpectRefused("gripper " + mine + " --out " + mine, written_over);
  ExpectRefused("evaluate " + box + " --gripper pand", "the nearest name is panda\n");
  ExpectRefused("evaluate " + box + " --gripper " + dir + "none.toml", "none.toml");
  ExpectRefused("evaluate " + box + " --jaw-opening 0.085",
                "the palm is narrower than the open fingers: --jaw-opening 0.085 (command line)");
  ExpectRefused("evaluate " + box + " --gripper panda --gripper-palm-length 0.1",
                "the palm is narrower than the open fingers: --gripper-palm-length 0.1 (command");
  ExpectRefused("evaluate " + box + " --gripper panda --gripper-finger-thickness -0.01",
                "gripper.finger_thickness = -0.01");
  ExpectRefused("gripper panda --out " + dir + "g.txt", ".txt");
  ExpectRefused("train --out " + dir + "r --set metric.jaw_opening=0.085",
                "the palm is narrower than the open fingers: metric.jaw_opening = 0.085");
  ExpectRefused("train --resume " + dir + "r --gripper panda", "--resume RUN alone");
  EXPECT_FALSE(fs::exists(folder / "r"));
  const std::string text = Antigrasp("gripper panda").text;
  const std::string narrow =
      folder.Write("narrow.toml", std::string(text).replace(text.find("0.2044"), 6, "0.0900"))
          .string();
  ExpectRefused("gripper " + narrow, "narrow.toml): expected a palm of at least 0.1104 m");
}

TEST(GripperCli, TheShippedExampleIsAGripper) {
  const Outcome outcome = Antigrasp("gripper " + kExample);
  EXPECT_EQ(outcome.code, 0) << outcome.text;
  EXPECT_TRUE(Holds(outcome.text, "jaw_opening = 0.06 ")) << outcome.text;
}

// The row of docs/grippers.md that begins with `key`, in metres.
std::vector<double> RowOf(const std::string& document, const std::string& key) {
  const std::string head = "| `" + key + "` |";
  std::vector<double> numbers;
  const std::size_t at = document.find(head);
  if (at == std::string::npos) return numbers;
  const std::size_t begin = at + head.size();
  std::istringstream row(document.substr(begin, document.find('\n', at) - begin));
  for (std::string cell; std::getline(row, cell, '|');) {
    if (cell.find_first_of("0123456789") != std::string::npos) {
      numbers.push_back(std::stod(cell) / 1000.0);
    }
  }
  return numbers;
}

TEST(GripperCli, TheDocumentHasTheNumbersOfTheProgram) {
  const std::string document = ReadFile(fs::path(ANTIGRASP_CONFIGS) / "../docs/grippers.md");
  std::map<std::string, std::vector<double>> expected;
  for (const NamedGripper& gripper : NamedGrippers()) {
    const GripperModel& m = gripper.model;
    expected["jaw_opening"].push_back(gripper.jaw_opening);
    expected["palm_distance"].push_back(m.palm_distance);
    expected["fingertip_overlap"].push_back(m.fingertip_overlap);
    expected["finger_width"].push_back(m.finger_width);
    expected["finger_thickness"].push_back(m.finger_thickness);
    expected["palm_depth"].push_back(m.palm_depth);
    expected["palm_length"].push_back(m.palm_length);
    expected["palm_width"].push_back(m.palm_width);
  }
  for (const auto& [key, numbers] : expected) {
    const std::vector<double> written = RowOf(document, key);
    ASSERT_EQ(written.size(), numbers.size()) << key;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      EXPECT_NEAR(written[i], numbers[i], 1e-9) << key;
    }
  }
}

}  // namespace
}  // namespace antigrasp
