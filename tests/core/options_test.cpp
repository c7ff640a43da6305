#include "antigrasp/core/options.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>
#include <vector>

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
  // By letters put in, left out or replaced, at one each; the first listed of equally near ones.
  bool value = false;
  OptionTable words;
  for (const char* key : {"abxyefghi", "abcdef", "zbxdef"}) words.Add(key, &value, "");
  EXPECT_EQ(MessageOf([&] { words.ApplyOverride("abxyef=1"); }),
            "unknown key abxyef (--set): expected a known key; the nearest is abcdef");
  EXPECT_EQ(MessageOf([&] { words.ApplyOverride("abxdef=1"); }),
            "unknown key abxdef (--set): expected a known key; the nearest is abcdef");
  EXPECT_EQ(MessageOf([&] { OptionTable().ApplyOverride("a=1"); }),
            "unknown key a (--set): expected no keys");
}

TEST(OptionTable, AssignsNothingWhenAnyValueIsBad) {
  Sample sample;
  OptionTable table = TableOf(&sample);
  // TOML tables are read in the order of their keys: something good on either side of the bad one.
  EXPECT_THROW(table.ApplyText("seed = 5\n[a]\ncount = 5\n[b]\nrate = 7\n", "x.toml"), InputError);
  EXPECT_EQ(sample.seed, 1U);
  EXPECT_EQ(sample.count, 3);
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

TEST(OptionTable, BothEndsOfARangeAreInIt) {
  Sample sample;
  OptionTable table = TableOf(&sample);
  for (const int count : {1, 10}) {
    table.ApplyOverride("a.count=" + std::to_string(count));
    EXPECT_EQ(sample.count, count);
  }
  table.ApplyOverride("seed=0");
  EXPECT_EQ(sample.seed, 0U);
  for (const double rate : {0.0, 1.0}) {
    table.ApplyOverride("b.rate=" + std::to_string(rate));
    EXPECT_EQ(sample.rate, rate);
  }
  for (const char* outside :
       {"a.count=0", "a.count=11", "b.rate=-1e-9", "b.rate=1.000001", "b.rate=inf"}) {
    EXPECT_THROW(table.ApplyOverride(outside), InputError) << outside;
  }
}

struct Unbounded {
  int whole = 0;
  double at_least = 3.0, any = -0.5;
  std::string text = "a \"b\"";
  bool off = false;
};

OptionTable TableOf(Unbounded* values) {
  const double inf = std::numeric_limits<double>::infinity();
  OptionTable table;
  table.Add("m.whole", &values->whole, -inf, inf, "any whole");
  table.Add("m.low", &values->at_least, 2.5, inf, "half open");
  table.Add("k.any", &values->any, -inf, inf, "any number");
  table.Add("top", &values->text, {}, "any text");
  table.Add("k.off", &values->off, "no");
  return table;
}

TEST(OptionTable, SaysWhatEachOptionTakes) {
  Sample sample;
  std::vector<std::string> accepted, keys;
  const OptionTable ranged = TableOf(&sample);
  for (const Option& option : ranged.options()) accepted.push_back(Accepted(option));
  EXPECT_EQ(accepted, (std::vector<std::string>{"true or false", "a whole number in [1, 10]",
                                                "a whole number of at least 0",
                                                "a number in [0, 1]", "one of slow, fast"}));
  Unbounded values;
  accepted.clear();
  const OptionTable unbounded = TableOf(&values);
  for (const Option& option : unbounded.options()) {
    accepted.push_back(Accepted(option));
    keys.push_back(option.key + ": " + option.help);
  }
  EXPECT_EQ(accepted, (std::vector<std::string>{"a whole number", "a number of at least 2.5",
                                                "a number", "text", "true or false"}));
  EXPECT_EQ(keys, (std::vector<std::string>{"m.whole: any whole", "m.low: half open",
                                            "k.any: any number", "top: any text", "k.off: no"}));
}

TEST(OptionTable, DumpIsTomlWithSectionsInTheOrderOfTheOptions) {
  Unbounded values;
  values.whole = -7;
  EXPECT_EQ(TableOf(&values).Dump(),
            "top = 'a \"b\"'  # any text\n"
            "\n[m]\nwhole = -7  # any whole\nlow = 3.0  # half open\n"
            "\n[k]\nany = -0.5  # any number\noff = false  # no\n");
}

TEST(OptionTable, SectionsMayBeNested) {
  bool value = true;
  OptionTable table;
  table.Add("p.q.r", &value, "deep");
  EXPECT_EQ(table.Dump(), "[p.q]\nr = true  # deep\n");
  table.ApplyText("[p.q]\nr = false\n", "x.toml");
  EXPECT_FALSE(value);
}

TEST(OptionTable, WholeNumbersMustFitThirtyTwoBits) {
  Unbounded values;
  OptionTable table = TableOf(&values);
  table.ApplyOverride("m.whole=2147483647");
  EXPECT_EQ(values.whole, 2147483647);
  table.ApplyOverride("m.whole=-2147483648");
  EXPECT_EQ(values.whole, std::numeric_limits<int>::min());
  EXPECT_EQ(MessageOf([&] { table.ApplyOverride("m.whole=2147483648"); }),
            "m.whole = 2147483648 (--set): expected a whole number");
}

TEST(OptionTable, OverridesSplitAtTheFirstEqualsSign) {
  Unbounded values;
  OptionTable table = TableOf(&values);
  table.ApplyOverride("top=x=y");
  EXPECT_EQ(values.text, "x=y");
  table.ApplyOverride("top=");
  EXPECT_EQ(values.text, "");
  EXPECT_EQ(MessageOf([&] { table.ApplyOverride("top"); }),
            "top (--set): expected key=value, e.g. gan.batch=32");
  EXPECT_EQ(MessageOf([&] { table.ApplyOverride("=3"); }),
            "=3 (--set): expected key=value, e.g. gan.batch=32");
  EXPECT_EQ(MessageOf([&] { table.ApplyValue("m.low", "2", "--low"); }),
            "m.low = 2 (--low): expected a number of at least 2.5");
}

// What another version wrote: its unknown keys go unless they begin with the given text.
TEST(OptionTable, KnownKeysOfAnotherVersionsFileAreTaken) {
  Sample sample;
  OptionTable table = TableOf(&sample);
  table.ApplyKnown("old = 1\n[a]\ncount = 4\nnew = 2\n[x.b]\nmode = 3\n", "x.toml", "b.");
  EXPECT_EQ(sample.count, 4);
  EXPECT_EQ(MessageOf([&] { table.ApplyKnown("[a]\ncount = 5\n[b]\nmoed = 2\n", "x.toml", "b."); }),
            "unknown key b.moed (x.toml:4): expected a known key; the nearest is b.mode");
  EXPECT_EQ(sample.count, 4);
  EXPECT_THROW(table.ApplyText("old = 1\n", "x.toml"), InputError);
}

}  // namespace
}  // namespace antigrasp
