// A set tried in physics into a folder: stopped, gone on with, told.
#include "antigrasp/trial/object_trials.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "antigrasp/core/error.h"
#include "antigrasp/mesh/mesh_file.h"
#include "antigrasp/trial/trial_folders.h"
#include "antigrasp/trial/trial_results.h"
#include "tests/support/csv_rows.h"
#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

// Interrupts when the work of a call has been reported so many times.
class Impatient final : public RunObserver {
 public:
  explicit Impatient(int reports) : left_(reports) {}
  ProgressFn Phase(const std::string&) override {
    return [this](std::int64_t, std::int64_t) {
      if (--left_ == 0) throw Interrupted();
    };
  }
  void Detail(const std::string&) override {}
  void Note(const std::string&) override {}
  bool StopRequested() const override { return false; }

 private:
  int left_;
};

// Three boxes and their originals: 12 trials at own and at equal mass.
class ObjectTrials : public testing::Test {
 protected:
  ObjectTrials() {
    for (const char* side : {"before", "after"}) {
      std::filesystem::create_directories(folder_ / side);
      for (const double width : {30.0, 32.0, 34.0}) {
        WriteMesh(folder_ / side / (std::to_string(int(width)) + ".stl"),
                  shapes::Box({width, 36.0, side[0] == 'b' ? 50.0 : 45.0}));
      }
    }
    metric_.object_min_extent = 0.0;
    metric_.units = LengthUnit::kMm;
    metric_.num_grasps = 4;
    metric_.num_draws = 1;
    options_.draws = 2;
    request_.frictions = {0.5};
    request_.inputs = {(folder_ / "after").string()};
    request_.baseline = {(folder_ / "before").string()};
    request_.threads = 1;
    request_.replays = 1;
  }
  // `reports`: of progress, before it is interrupted; 0: never.
  PhysicsTrialReport Try(const std::string& out, int reports = 0) {
    request_.out = out.empty() ? "" : (folder_ / out).string();
    Impatient observer(reports);
    return TryInPhysics(request_, metric_, options_, &observer);
  }
  std::string WhyNot(const std::string& out) {
    try {
      Try(out);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  shapes::TempFolder folder_;
  MetricOptions metric_;
  PhysicsTrialOptions options_;
  PhysicsTrialRequest request_;
};

// Stopped within the first kind of mass, between the two, after one side of a pair, and twice.
TEST_F(ObjectTrials, WhatAnInterruptedCallHasTriedIsKeptAndTheSameCallGoesOnToTheSameBytes) {
  const PhysicsTrialReport whole = Try("whole");
  EXPECT_FALSE(whole.interrupted);
  const auto files = shapes::FileContents(folder_ / "whole");
  const auto all = shapes::CsvRows(folder_ / "whole/trials.csv");
  ASSERT_EQ(all.size(), 12U);
  for (const int stop : {1, 4, 6, 7}) {
    const std::string out = "stopped-" + std::to_string(stop);
    const PhysicsTrialReport report = Try(out, stop);
    EXPECT_TRUE(report.interrupted);
    EXPECT_NE(report.text.find("stopped after " + std::to_string(stop) + " of 12 trials"),
              std::string::npos)
        << report.text;
    const auto rows = shapes::CsvRows(folder_ / out / "trials.csv");
    ASSERT_EQ(rows.size(), static_cast<std::size_t>(stop));
    for (std::size_t i = 0; i < rows.size(); ++i) EXPECT_EQ(rows[i], all[i]);
    const auto unfinished = ReadUnfinished(folder_ / out);
    ASSERT_TRUE(unfinished);
    EXPECT_EQ(unfinished->done, static_cast<std::uint64_t>(stop));
    EXPECT_THROW(Try(out, 1), Interrupted);  // before it came to anything new
    EXPECT_EQ(shapes::CsvRows(folder_ / out / "trials.csv").size(), rows.size());
    Try(out, stop + 2);
    EXPECT_EQ(shapes::CsvRows(folder_ / out / "trials.csv").size(), rows.size() + 2);
    request_.threads = 3;  // which nothing depends on
    const PhysicsTrialReport rest = Try(out);
    request_.threads = 1;
    EXPECT_FALSE(rest.interrupted);
    EXPECT_EQ(
        rest.text.substr(0, rest.text.rfind((folder_ / out).string() + ": trials.csv")),
        whole.text.substr(0, whole.text.rfind((folder_ / "whole").string() + ": trials.csv")));
    EXPECT_TRUE(shapes::FileContents(folder_ / out) == files) << stop;
    EXPECT_FALSE(ReadUnfinished(folder_ / out));
  }
}

TEST_F(ObjectTrials, AnInterruptedFolderIsNotGoneOnWithByAnotherCall) {
  Try("t", 3);
  const auto before = shapes::FileContents(folder_ / "t");
  request_.seed = 2;
  EXPECT_NE(WhyNot("t").find("holds an interrupted trial of other settings"), std::string::npos);
  request_.seed = 1;
  request_.replays = 0;
  EXPECT_NE(WhyNot("t").find("other settings"), std::string::npos);
  request_.replays = 1;
  WriteMesh(folder_ / "after/30.stl", shapes::Box({30.0, 36.0, 46.0}));
  EXPECT_NE(WhyNot("t").find("holds an interrupted trial of other objects"), std::string::npos)
      << WhyNot("t");
  EXPECT_TRUE(before == shapes::FileContents(folder_ / "t"));
  request_.overwrite = true;
  EXPECT_EQ(WhyNot("t"), "");
  EXPECT_FALSE(ReadUnfinished(folder_ / "t"));
  request_.overwrite = false;
  EXPECT_NE(WhyNot("t").find("holds trials.csv already"), std::string::npos) << WhyNot("t");
}

TEST_F(ObjectTrials, AnInterruptedFolderOfFewerObjectsOrAnotherProgramIsCalledThat) {
  Try("t", 3);
  WriteMesh(folder_ / "after/99.stl", shapes::Box({30.0, 36.0, 46.0}));
  WriteMesh(folder_ / "before/99.stl", shapes::Box({30.0, 36.0, 46.0}));
  EXPECT_NE(WhyNot("t").find("holds an interrupted trial of other objects"), std::string::npos)
      << WhyNot("t");
  std::filesystem::remove(folder_ / "after/99.stl");
  std::string toml = ReadFile(folder_ / "t/trial.toml");
  const std::size_t at = toml.find("program = ");
  toml.replace(at, toml.find('\n', at) - at, "program = '0.0 abc'");
  WriteFileAtomic(folder_ / "t/trial.toml", toml);
  EXPECT_NE(WhyNot("t").find("an interrupted trial of antigrasp 0.0 abc"), std::string::npos)
      << WhyNot("t");
}

TEST_F(ObjectTrials, AnInterruptedFolderWhoseTablesWereChangedIsNotGoneOnWith) {
  Try("t", 3);
  const auto left = shapes::FileContents(folder_ / "t");
  for (const char* table : {"trials.csv", "executions.csv", "replays.json"}) {
    const auto path = folder_ / "t" / table;
    const std::string as_left = ReadFile(path);
    std::string changed = as_left;
    const std::size_t digit = changed.find_last_of("0123456789");
    changed[digit] = changed[digit] == '1' ? '2' : '1';
    for (const std::string& bad : {changed, as_left.substr(0, as_left.size() / 2)}) {
      WriteFileAtomic(path, bad);
      EXPECT_NE(WhyNot("t").find("holds an interrupted trial whose tables were changed"),
                std::string::npos)
          << table << WhyNot("t");
    }
    WriteFileAtomic(path, as_left);
  }
  EXPECT_TRUE(left == shapes::FileContents(folder_ / "t"));
  EXPECT_FALSE(Try("t").interrupted);
}

TEST_F(ObjectTrials, ACallThatIsStoppedInItsLastTrialIsFinished) {
  const PhysicsTrialReport whole = Try("whole");
  const int all = static_cast<int>(shapes::CsvRows(folder_ / "whole/trials.csv").size());
  const PhysicsTrialReport last = Try("last", all);
  EXPECT_FALSE(last.interrupted) << last.text;
  EXPECT_TRUE(shapes::FileContents(folder_ / "whole") == shapes::FileContents(folder_ / "last"));
}

TEST_F(ObjectTrials, WithoutAFolderAnInterruptedCallTellsWhatItTried) {
  const PhysicsTrialReport report = Try("", 3);
  EXPECT_TRUE(report.interrupted);
  EXPECT_NE(report.text.find("(1 pairs)"), std::string::npos) << report.text;
  EXPECT_NE(report.text.find("stopped after 3 of 12 trials of an object, which are not kept"),
            std::string::npos)
      << report.text;
}

TEST_F(ObjectTrials, AFolderSaysInWordsWhatItHolds) {
  Try("t", 9);
  const std::string text = TrialFolderText((folder_ / "t").string());
  EXPECT_TRUE(text.starts_with((folder_ / "t").string() +
                               ": trials, six-ways, fingertip sphere of 5 mm, mujoco "))
      << text;
  EXPECT_NE(text.find("  interrupted after 9 of 12 trials of an object\n"), std::string::npos);
  EXPECT_NE(text.find("  friction 0.5, own mass, 1 g: held "), std::string::npos) << text;
  EXPECT_NE(text.find(" points (3 pairs)\n"), std::string::npos) << text;
  EXPECT_NE(text.find(" points (1 pairs)\n"), std::string::npos) << text;  // at equal mass
}

// Of a comparison the first side of the first object: no pair, so no mean.
TEST_F(ObjectTrials, AFolderWithoutAMeanYetSaysSo) {
  Try("t", 1);
  const std::string folder = (folder_ / "t").string();
  EXPECT_EQ(TrialFolderText(folder),
            folder + ": trials, interrupted after 1 of 12 trials of an object; no means yet\n");
  try {
    ReadTrialFolders({folder});
    FAIL() << "read";
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()).find("interrupted after 1 of 12 trials of an object"), 0u)
        << error.what();
  }
}

// As wide as the jaws open at most: its success is unknown, not 0.
TEST_F(ObjectTrials, AnObjectThatNoGraspReachesIsInNoMeanAndIsCounted) {
  WriteMesh(folder_ / "after/32.stl", shapes::Box({90.0, 90.0, 90.0}));
  const PhysicsTrialReport report = Try("t");
  EXPECT_NE(report.text.find("(mean over 2 of 3 objects; not in it: 1 no reachable grasp)"),
            std::string::npos)
      << report.text;
  EXPECT_NE(report.text.find("(2 pairs; not paired: 1 after: no reachable grasp)"),
            std::string::npos)
      << report.text;
  for (const auto& row : shapes::CsvRows(folder_ / "t/trials.csv")) {
    const bool wide = row.at("object") == "32.stl" && row.at("side") == "after";
    EXPECT_EQ(row.at("status"), wide ? "no reachable grasp" : "ok");
    EXPECT_EQ(row.at("held").empty(), wide);
  }
  for (const auto& row : shapes::CsvRows(folder_ / "t/means.csv")) {
    EXPECT_EQ(row.at("pairs"), row.at("grasps") == "candidates kept" ? "3" : "2");
  }
  request_.inputs = {(folder_ / "after/32.stl").string()};
  request_.baseline = {};
  EXPECT_NE(WhyNot("alone").find("no object could be tried; 32.stl: no reachable grasp"),
            std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "alone"));
  options_.protocol = ProtocolName::kPaper;  // which wants grasps: none found is none held
  options_.series.series = 1;
  EXPECT_EQ(WhyNot("alone"), "");
  EXPECT_EQ(shapes::CsvRows(folder_ / "alone/trials.csv")[0].at("held"), "0");
}

}  // namespace
}  // namespace antigrasp
