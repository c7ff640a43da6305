// A program of somebody else as judge: tests/judge/odd_judge.py, good and odd.
#include "antigrasp/judge/program_judge.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <thread>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/error.h"
#include "tests/support/shapes.h"
#include "tests/support/temp_folder.h"

namespace antigrasp {
namespace {

std::string Odd(const std::string& mode) {
  return std::string(ANTIGRASP_PYTHON) + " " + ANTIGRASP_TEST_FOLDER + "/odd_judge.py " + mode;
}

// Prisms of different numbers of triangles: the score of each is its own.
class Objects {
 public:
  explicit Objects(const std::vector<std::string>& names) : names_(names) {
    for (std::size_t i = 0; i < names.size(); ++i) {
      meshes_.push_back(shapes::Cylinder(1.0, 3.0, 3 + static_cast<int>(i)));
    }
  }
  std::vector<JudgedObject> Shown() const {
    std::vector<JudgedObject> shown;
    for (std::size_t i = 0; i < names_.size(); ++i) shown.push_back({names_[i], &meshes_[i]});
    return shown;
  }
  double Triangles(std::size_t i) const { return static_cast<double>(meshes_[i].faces.size()); }

 private:
  std::vector<std::string> names_;
  std::vector<TriangleMesh> meshes_;
};

// "0.12" or the status, one after another, blanks between.
std::string Said(const std::vector<Verdict>& verdicts, const Objects& objects) {
  std::string text;
  for (std::size_t i = 0; i < verdicts.size(); ++i) {
    const Verdict& one = verdicts[i];
    EXPECT_EQ(one.score.has_value(), one.status == Verdict::kOk);
    const bool own = one.score && *one.score == objects.Triangles(i) / 100.0;
    text += (i == 0 ? "" : "; ") + (own ? "own" : one.score ? "another's" : one.status);
  }
  return text;
}

std::string Notes(const Judge& judge) {
  std::string text;
  for (const std::string& note : judge.Notes()) text += note + "\n";
  return text;
}

constexpr ProgramLimits kPatient = {60.0, 2};

TEST(ProgramJudge, AnswersBelongToTheirIdsInAnyOrder) {
  ProgramJudge judge(Odd("backwards"), {}, kPatient);
  const Objects objects({"a", "b", "a/c.stl"}), others({"a", "b", "c"});
  EXPECT_EQ(Said(judge.Score(objects.Shown()), objects), "own; own; own");
  EXPECT_EQ(Said(judge.Score(others.Shown()), others), "own; own; own");  // by the same program
  EXPECT_EQ(Notes(judge), "");
  EXPECT_EQ(judge.Stopped(), "");
  EXPECT_TRUE(judge.Score({}).empty());
}

TEST(ProgramJudge, WhatIsNoFiniteNumberIsAStatus) {
  ProgramJudge judge(Odd("words"), {}, kPatient);
  const Objects objects({"nan", "null", "inf", "text", "nothing at all"});
  EXPECT_EQ(Said(judge.Score(objects.Shown()), objects),
            "not a finite number; no score; not a finite number; not a finite number; "
            "not a finite number");
  const Objects big({"big"});
  EXPECT_EQ(judge.Score(big.Shown()).front().score, 1e308);
}

TEST(ProgramJudge, IsToldTheSizeThatTheMetricLooksAt) {
  MetricOptions metric;
  metric.object_min_extent = 0.0;
  metric.units = LengthUnit::kMm;
  ProgramJudge judge(Odd("echo"), metric, kPatient);
  const Objects objects({"a", "b"});
  const std::vector<Verdict> verdicts = judge.Score(objects.Shown());
  EXPECT_EQ(verdicts[0].score, 0.001);
  EXPECT_EQ(verdicts[1].score, 0.001);
  // It says everything twice, and a third thing of an object that nobody asked about. The last two
  // lines come when nobody waits any more.
  EXPECT_EQ(Notes(judge),
            "1 lines are no answer, the first: {\"id\": 99999, \"score\": 7}\n"
            "1 answers came late or twice\n");
}

// 4000 lines of 48 bytes do not fit into a pipe, nor do the requests of 800 objects.
TEST(ProgramJudge, NeitherSideBlocksTheOther) {
  ProgramJudge judge(Odd("chatty"), {}, kPatient);
  const TriangleMesh cube = shapes::Cube();
  const std::vector<JudgedObject> objects(800, {std::string(60, 'x'), &cube});
  for (const Verdict& verdict : judge.Score(objects)) EXPECT_EQ(verdict.score, 0.12);
  EXPECT_EQ(Notes(judge),
            "4000 lines are no answer, the first: thinking hard about number 000000 "
            "......................\n");
}

TEST(ProgramJudge, OneThatDiesIsStartedAgainAndAskedWhatItHasNotAnswered) {
  ProgramJudge judge(Odd("fragile"), {}, kPatient);
  const Objects objects({"a", "bad", "c", "d"});
  EXPECT_EQ(Said(judge.Score(objects.Shown()), objects), "own; judge died; own; own");
  EXPECT_EQ(Notes(judge), "started again 2 times, last: ended with exit code 5\n");
  EXPECT_EQ(judge.Stopped(), "");
  const Objects more({"e"});
  EXPECT_EQ(Said(judge.Score(more.Shown()), more), "own");
}

TEST(ProgramJudge, AfterSoManyRestartsItStopsAndWhatItAnsweredStays) {
  ProgramJudge judge(Odd("fragile"), {}, {60.0, 1});
  const Objects objects({"a", "bad", "c", "d"});
  EXPECT_EQ(Said(judge.Score(objects.Shown()), objects),
            "own; judge died; judge stopped; judge stopped");
  EXPECT_NE(judge.Stopped().find("ended with exit code 5 after 1 restarts"), std::string::npos)
      << judge.Stopped();
  EXPECT_EQ(Said(judge.Score(objects.Shown()), objects),
            "judge stopped; judge stopped; judge stopped; judge stopped");
}

// Without an answer to `bad` the others are answered at once; two seconds of silence make it late.
TEST(ProgramJudge, AnObjectWithoutAnAnswerIsLateAndTheOthersAreNot) {
  ProgramJudge judge(Odd("sleepy"), {}, {2.0, 0});
  const Objects objects({"a", "bad", "c"});
  EXPECT_EQ(Said(judge.Score(objects.Shown()), objects), "own; late; own");
  EXPECT_EQ(Notes(judge), "");
}

// The second silence in a row is that of a program that hangs: `c` is late, too, `d` is not.
TEST(ProgramJudge, OneThatHangsIsKilledAndStartedAgain) {
  ProgramJudge judge(Odd("hangs"), {}, {2.0, 1});
  const Objects objects({"a", "bad", "c", "d"});
  EXPECT_EQ(Said(judge.Score(objects.Shown()), objects), "own; late; late; own");
  EXPECT_EQ(Notes(judge), "started again 1 times, last: silent for 4.0s\n");
}

TEST(ProgramJudge, ACommandThatDoesNotExistIsRefused) {
  ProgramJudge judge("no-such-judge --fast", {}, kPatient);
  const Objects objects({"a"});
  try {
    judge.Score(objects.Shown());
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(),
                 "no command no-such-judge --fast (--judge): expected epsilon, settled, trial, "
                 "trial:PROTOCOL or a program");
  }
  ProgramJudge deaf(Odd("deaf"), {}, kPatient);
  EXPECT_EQ(Said(deaf.Score(objects.Shown()), objects), "judge died");
  EXPECT_NE(Notes(deaf).find("the first: not in the mood"), std::string::npos) << Notes(deaf);
}

// Whether a process of this number runs; one that has ended and that nobody asked after does not.
bool Runs(const std::string& pid) {
  std::ifstream file("/proc/" + pid + "/cmdline");
  return file.get() != std::ifstream::traits_type::eof();
}

// The program stays when its input ends: it is killed with the judge.
TEST(ProgramJudge, NothingIsLeftOfIt) {
  const shapes::TempFolder folder;
  const std::string temporary = (folder / "tmp").string();
  std::filesystem::create_directory(temporary);
  setenv("TMPDIR", temporary.c_str(), 1);
  {
    ProgramJudge judge(Odd("stays " + (folder / "pid").string()), {}, kPatient);
    const Objects objects({"a"});
    EXPECT_EQ(Said(judge.Score(objects.Shown()), objects), "own");
    EXPECT_EQ(shapes::CountFiles(temporary), 1);  // the empty folder of meshes
    EXPECT_TRUE(Runs(ReadFile(folder / "pid")));
  }
  unsetenv("TMPDIR");
  EXPECT_EQ(shapes::CountFiles(temporary), 0);
  // The shell was waited for; what it had started goes by the same signal, a moment later.
  for (int i = 0; i < 1000 && Runs(ReadFile(folder / "pid")); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  EXPECT_FALSE(Runs(ReadFile(folder / "pid")));
}

// Called while it waits for an answer that does not come: how a Ctrl-C gets in.
TEST(ProgramJudge, WaitingCanBeInterrupted) {
  int ticks = 0;
  ProgramJudge judge(Odd("sleepy"), {}, kPatient, [&ticks] {
    if (++ticks == 3) throw Interrupted();
  });
  const Objects objects({"bad"});
  EXPECT_THROW(judge.Score(objects.Shown()), Interrupted);
}

}  // namespace
}  // namespace antigrasp
