#include "antigrasp/core/nearest.h"

#include <gtest/gtest.h>

namespace antigrasp {
namespace {

const std::vector<std::string> kNames = {"train", "trial", "sample", "evaluate", "export"};

TEST(Nearest, IsTheNameWithTheFewestSlips) {
  EXPECT_EQ(Nearest("evalute", kNames), "evaluate");  // a letter left out
  EXPECT_EQ(Nearest("exxport", kNames), "export");    // put in
  EXPECT_EQ(Nearest("samble", kNames), "sample");     // changed
  EXPECT_EQ(Nearest("trila", kNames), "trial");       // exchanged: two changes to "train"
  EXPECT_EQ(Nearest("evaluate", kNames), "evaluate");
  EXPECT_EQ(Nearest("ab", {"abcde", "ba"}), "ba");  // one exchange, three letters left out
}

TEST(Nearest, OfSeveralIsTheFirst) {
  EXPECT_EQ(Nearest("trian", kNames), "train");  // an exchange, or a change to "trial"
  EXPECT_EQ(Nearest("cat", {"bat", "hat"}), "bat");
  EXPECT_EQ(Nearest("cat", {"hat", "bat"}), "hat");
}

TEST(Nearest, IsSomethingForAnyWordAndNothingWithoutNames) {
  EXPECT_EQ(Nearest("", {"train", "fly"}), "fly");
  EXPECT_EQ(Nearest("xyz", {"train"}), "train");
  EXPECT_EQ(Nearest("train", {}), "");
}

}  // namespace
}  // namespace antigrasp
