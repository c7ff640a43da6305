// How long a run will take, in numbers that are easy to multiply.
#include "antigrasp/train/forecast.h"

#include <gtest/gtest.h>

#include <cmath>

#include "antigrasp/core/observer.h"
#include "antigrasp/train/cem_run.h"
#include "tests/support/temp_folder.h"
#include "tests/train/tiny_run.h"

namespace antigrasp {
namespace {

// 100 updates, then 10 in each of three episodes.
RunConfig Hundred() {
  RunConfig config;
  config.cem.prior_iterations = 100;
  config.cem.iterations = 10;
  config.cem.episodes = 3;
  config.cem.samples = 50;
  return config;
}

TEST(Forecast, UpdatesAreThoseThatTheEpisodesMake) {
  RunConfig config = Hundred();
  EXPECT_EQ(UpdatesOf(config, 0), 100);
  EXPECT_EQ(UpdatesOf(config, 3), 10);
  config.start = "networks";
  EXPECT_EQ(UpdatesOf(config, 0), 0);
  config.fine_tune = true;
  EXPECT_EQ(UpdatesOf(config, 0), 100);
  config.cem.mode = EpisodeMode::kLatent;
  EXPECT_EQ(UpdatesOf(config, 0), 100);
  EXPECT_EQ(UpdatesOf(config, 1), 0);
}

TEST(Forecast, WhatIsLeftCountsTheControlsEpisodesToo) {
  RunConfig config = Hundred();
  const Pace pace{.update = 2.0, .stage = 7.0};
  EXPECT_EQ(SecondsLeft(config, pace, 0), 130 * 2.0 + 4 * 7.0);
  EXPECT_EQ(SecondsLeft(config, pace, 2), 20 * 2.0 + 2 * 7.0);
  config.cem.control = true;  // scores what it begins with as well
  EXPECT_EQ(SecondsLeft(config, pace, 2), 20 * 2.0 + 2 * 7.0 + 30 * 2.0 + 4 * 7.0);
  EXPECT_TRUE(std::isnan(SecondsLeft(config, {.stage = 7.0}, 2)));
  EXPECT_TRUE(std::isnan(SecondsLeft(config, {.update = 2.0}, 2)));
  config.cem.mode = EpisodeMode::kLatent;  // no update is left, so none needs to be known
  EXPECT_EQ(SecondsLeft(config, {.stage = 7.0}, 2), 6 * 7.0);
}

TEST(Forecast, SaysHowLongAnEpisodeTheRunAndAsManyUpdatesAsThePapersTake) {
  RunConfig config = Hundred();
  EXPECT_EQ(
      TrainingForecast(config, 0.5),
      "an update takes 0.5s, those of episode 0 50s (100), of each later one 5.0s (10), of "
      "the whole run 1m 05s (130); as many as the paper's, with these networks, 8h 53m (64000)");
  config.start = "networks";
  config.cem.control = true;
  EXPECT_EQ(TrainingForecast(config, 0.5),
            "an update takes 0.5s, of each later one 5.0s (10), of the whole run 30s (60) with its "
            "control; as many as the paper's, with these networks, 8h 53m (64000)");
  EXPECT_EQ(RunForecast(config, {.update = 0.5, .stage = 20.0}, 1),
            "sampling and scoring 50 objects took 20s: about 2m 50s to the end of the run");
}

// Notes of a run, in order.
class NoteTaker : public SilentObserver {
 public:
  void Note(const std::string& text) override { notes.push_back(text); }
  std::vector<std::string> notes;
};

TEST(Forecast, IsToldOnceAfterTheFirstUpdatesAndTheFirstStage) {
  const shapes::TempFolder folder;
  NoteTaker observer;
  StartRun(shapes::Tiny(), folder / "run", &observer);
  ASSERT_EQ(observer.notes.size(), 2u);
  EXPECT_TRUE(observer.notes[0].starts_with("an update takes ")) << observer.notes[0];
  EXPECT_TRUE(observer.notes[1].starts_with("sampling and scoring 8 objects took "));
  // With networks to begin with, the updates come after the first stage.
  NoteTaker later;
  RunConfig config = shapes::Tiny();
  config.start = (folder / "run/episode_0/checkpoint.pt").string();
  config.cem.iterations = 10;
  StartRun(config, folder / "later", &later);
  ASSERT_EQ(later.notes.size(), 2u);
  EXPECT_TRUE(later.notes[0].starts_with("an update takes ")) << later.notes[0];
}

}  // namespace
}  // namespace antigrasp
