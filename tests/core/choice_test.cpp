#include "antigrasp/core/choice.h"

#include <gtest/gtest.h>

#include <array>

#include "antigrasp/core/error.h"
#include "antigrasp/core/options.h"

namespace antigrasp {
namespace {

// Listed in another order than declared.
enum class Gear { kReverse, kSlow, kFast };
constexpr auto ChoicesOf(Gear) {
  return std::to_array<Choice<Gear>>(
      {{Gear::kFast, "fast"}, {Gear::kReverse, "reverse"}, {Gear::kSlow, "slow"}});
}

TEST(Choice, NamesValuesInTheOrderOfTheList) {
  EXPECT_EQ(ChoiceNames<Gear>(), (std::vector<std::string>{"fast", "reverse", "slow"}));
  EXPECT_EQ(ChoiceName(Gear::kSlow), "slow");
  EXPECT_EQ(FindChoice<Gear>("reverse"), Gear::kReverse);
  EXPECT_EQ(FindChoice<Gear>("Reverse"), std::nullopt);
  EXPECT_EQ(FindChoice<Gear>(""), std::nullopt);
}

TEST(Choice, AlternativesAreWordsOfASentence) {
  EXPECT_EQ(Alternatives({"a"}), "a");
  EXPECT_EQ(Alternatives({"a", "b"}), "a or b");
  EXPECT_EQ(Alternatives({"stl", "obj", "ply"}, "*."), "*.stl, *.obj or *.ply");
}

TEST(OptionTable, SetsAndSavesAnEnumByItsName) {
  Gear gear = Gear::kSlow;
  OptionTable table;
  table.Add("car.gear", &gear, "how it goes");
  EXPECT_EQ(table.Dump(), "[car]\ngear = 'slow'  # how it goes\n");
  table.ApplyText("[car]\ngear = \"reverse\"\n", "x.toml");
  EXPECT_EQ(gear, Gear::kReverse);
  table.ApplyOverride("car.gear=fast");  // without the quotes of TOML
  EXPECT_EQ(gear, Gear::kFast);
  EXPECT_EQ(ValueText(table.options()[0]), "'fast'");
}

TEST(OptionTable, RefusesWhatNoValueOfAnEnumIsCalledAndNamesThoseThatThereAre) {
  Gear gear = Gear::kSlow;
  OptionTable table;
  table.Add("car.gear", &gear, "");
  for (const char* text : {"[car]\ngear = \"third\"\n", "[car]\ngear = 1\n"}) {
    try {
      table.ApplyText(text, "x.toml");
      ADD_FAILURE() << text;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("(x.toml:2): expected one of fast, reverse, slow"),
                std::string::npos)
          << error.what();
    }
  }
  EXPECT_EQ(gear, Gear::kSlow);
}

}  // namespace
}  // namespace antigrasp
