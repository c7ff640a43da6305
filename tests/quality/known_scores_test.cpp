#include "antigrasp/quality/known_scores.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace antigrasp {
namespace {

std::set<std::string_view> NamesAt(const MetricOptions& options) {
  std::set<std::string_view> names;
  for (const KnownSet* set : KnownSetsAt(options)) names.insert(set->name);
  return names;
}

TEST(KnownScores, EveryPresetHasTheSetsThatShip) {
  for (const std::string& preset : MetricPresetNames()) {
    MetricOptions options;
    ApplyMetricPreset(preset, &options);
    EXPECT_EQ(NamesAt(options),
              (std::set<std::string_view>{"bottles", "bottles-adversarial", "cylinders",
                                          "cylinders-adversarial", "prisms", "prisms-adversarial"}))
        << preset;
    for (const KnownSet* set : KnownSetsAt(options)) {
      EXPECT_EQ(set->preset, preset);
      EXPECT_GT(set->scores.size(), 190U) << preset << set->name;
      EXPECT_LE(set->scores.size(), 200U) << preset << set->name;
      EXPECT_TRUE(std::is_sorted(set->scores.begin(), set->scores.end())) << preset << set->name;
      EXPECT_GE(set->scores.front(), 0.0);
      EXPECT_LE(set->scores.back(), preset == "settled" ? 1.0 : 0.05);
    }
  }
}

TEST(KnownScores, AdversarialObjectsAreHarderThanThoseTheyCameFrom) {
  for (const char* kind : {"cylinders", "prisms", "bottles"}) {
    const auto sets = KnownSetsAt(MetricOptions());
    const auto median = [&](const std::string& name) {
      const auto set = std::find_if(sets.begin(), sets.end(),
                                    [&](const KnownSet* known) { return known->name == name; });
      return (*set)->scores[(*set)->scores.size() / 2];
    };
    EXPECT_LT(median(std::string(kind) + "-adversarial"), 0.9 * median(kind)) << kind;
  }
}

TEST(KnownScores, OtherConstantsHaveNoneAndOtherEffortHasThem) {
  MetricOptions options;
  options.num_grasps = 12;
  options.max_attempts = 77;
  options.adaptive = true;
  EXPECT_EQ(NamesAt(options).size(), 6U);
  for (double MetricOptions::*const constant :
       {&MetricOptions::friction, &MetricOptions::jaw_opening, &MetricOptions::object_min_extent,
        &MetricOptions::friction_std, &MetricOptions::percentile}) {
    MetricOptions other;
    other.*constant *= 1.01;
    EXPECT_TRUE(NamesAt(other).empty());
  }
  MetricOptions other;
  other.num_draws = 24;
  EXPECT_TRUE(NamesAt(other).empty());
  other = MetricOptions();
  other.gripper.finger_width *= 1.01;
  EXPECT_TRUE(NamesAt(other).empty());
}

TEST(KnownScores, AShareIsOfThoseBelowAndOfEqualOnesHalf) {
  const KnownSet set{"default", "by hand", {0.0, 0.0, 0.1, 0.2, 0.2, 0.2, 0.4, 0.8}};
  EXPECT_EQ(ShareBelow(0.0, set), 1.0 / 8.0);
  EXPECT_EQ(ShareBelow(0.05, set), 2.0 / 8.0);
  EXPECT_EQ(ShareBelow(0.2, set), 4.5 / 8.0);
  EXPECT_EQ(ShareBelow(0.3, set), 6.0 / 8.0);
  EXPECT_EQ(ShareBelow(0.9, set), 1.0);
}

}  // namespace
}  // namespace antigrasp
