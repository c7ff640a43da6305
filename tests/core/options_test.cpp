#include "antigrasp/core/options.h"

#include <gtest/gtest.h>

#include <functional>

#include "antigrasp/core/error.h"

namespace antigrasp {
namespace {

struct Sample {
  bool on = true;
  int count = 3;
  std::uint64_t seed = 1;
  double rate = 0.5;
  std::string mode = "slow";
};

OptionTable TableOf(Sample* sample) {
  OptionTable table;
  table.Add("a.on", &sample->on, "a switch");
  table.Add("a.count", &sample->count, 1, 10, "items");
  table.Add("seed", &sample->seed, "random seed");
  table.Add("b.rate", &sample->rate, 0, 1, "share");
  table.Add("b.mode", &sample->mode, {"slow", "fast"}, "how");
  return table;
}

std::string MessageOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(OptionTable, ReadsEveryTypeFromToml) {
  Sample sample;
  TableOf(&sample).ApplyText(
      "seed = 9\n[a]\non = false\ncount = 7\n[b]\nrate = 1\nmode = \"fast\"\n", "x.toml");
  EXPECT_FALSE(sample.on);
  EXPECT_EQ(sample.count, 7);
  EXPECT_EQ(sample.seed, 9U);
  EXPECT_EQ(sample.rate, 1.0);
  EXPECT_EQ(sample.mode, "fast");
}

TEST(OptionTable, NamesFileLineKeyValueAndRangeOfABadValue) {
  Sample sample;
  OptionTable table = TableOf(&sample);
  EXPECT_EQ(MessageOf([&] { table.ApplyText("[a]\ncount = 11\n", "x.toml"); }),
            "a.count = 11 (x.toml:2): expected a whole number in [1, 10]");
  EXPECT_EQ(MessageOf([&] { table.ApplyText("[b]\n\nmode = \"quick\"\n", "x.toml"); }),
            "b.mode = 'quick' (x.toml:3): expected one of slow, fast");
  EXPECT_EQ(MessageOf([&] { table.ApplyText("[b]\nrate = nan\n", "x.toml"); }),
            "b.rate = nan (x.toml:2): expected a number in [0, 1]");
  EXPECT_EQ(MessageOf([&] { table.ApplyOverride("seed=-1"); }),
            "seed = -1 (--set): expected a whole number of at least 0");
  EXPECT_EQ(MessageOf([&] { table.ApplyText("[a]\ncount = 2.5\n", "x.toml"); }),
            "a.count = 2.5 (x.toml:2): expected a whole number in [1, 10]");
}

TEST(OptionTable, NamesTheNearestKeyOfAnUnknownOne) {
  Sample sample;
  OptionTable table = TableOf(&sample);
  EXPECT_EQ(MessageOf([&] { table.ApplyText("[a]\ncuont = 1\n", "x.toml"); }),
            "unknown key a.cuont (x.toml:2): expected a known key; the nearest is a.count");
}

TEST(OptionTable, AssignsNothingWhenAnyValueIsBad) {
  Sample sample;
  OptionTable table = TableOf(&sample);
  EXPECT_THROW(table.ApplyText("seed = 5\n[a]\ncount = 0\n", "x.toml"), InputError);
  EXPECT_EQ(sample.seed, 1U);
}

TEST(OptionTable, RefusesBrokenTomlWithItsLine) {
  Sample sample;
  OptionTable table = TableOf(&sample);
  EXPECT_NE(MessageOf([&] { table.ApplyText("seed = 1\n[a\n", "x.toml"); }).find("x.toml:2"),
            std::string::npos);
}

TEST(OptionTable, OverridesTakeStringsWithoutQuotes) {
  Sample sample;
  OptionTable table = TableOf(&sample);
  table.ApplyOverride("b.mode=fast");
  table.ApplyOverride("a.on=false");
  EXPECT_EQ(sample.mode, "fast");
  EXPECT_FALSE(sample.on);
  EXPECT_THROW(table.ApplyOverride("b.mode"), InputError);
  EXPECT_THROW(table.ApplyOverride("a.count=1\nseed = 4"), InputError);
}

TEST(OptionTable, DumpReadsBackToTheSameValues) {
  Sample sample{false, 9, 77, 1.0 / 3, "fast"};
  const std::string text = TableOf(&sample).Dump();
  Sample other;
  TableOf(&other).ApplyText(text, "dump");
  EXPECT_EQ(other.on, sample.on);
  EXPECT_EQ(other.count, sample.count);
  EXPECT_EQ(other.seed, sample.seed);
  EXPECT_EQ(other.rate, sample.rate);
  EXPECT_EQ(other.mode, sample.mode);
}

TEST(OptionTable, AMissingFileIsOneClearLine) {
  Sample sample;
  OptionTable table = TableOf(&sample);
  EXPECT_EQ(MessageOf([&] { table.ApplyFile("/nowhere/demo.toml"); }),
            "no such file (/nowhere/demo.toml): expected a TOML configuration file");
}

}  // namespace
}  // namespace antigrasp
