#include "antigrasp/core/check.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "antigrasp/core/error.h"

namespace antigrasp {
namespace {

TEST(Check, AFalseConditionNamesItsPlaceItselfAndWhy) {
  const int line = __LINE__ + 2;
  try {
    AG_CHECK(1 + 1 == 3, "sums");
    FAIL() << "nothing thrown";
  } catch (const std::logic_error& error) {
    EXPECT_EQ(error.what(), std::string(__FILE__) + ":" + std::to_string(line) +
                                ": CHECK 1 + 1 == 3 failed: sums");
  }
}

TEST(Check, ATrueConditionIsLookedAtOnceAndItsMessageNotMade) {
  int looks = 0, messages = 0;
  const auto message = [&] { return "message " + std::to_string(++messages); };
  AG_CHECK(++looks > 0, message());
  EXPECT_EQ(looks, 1);
  EXPECT_EQ(messages, 0);
}

// Exit codes follow from the types: 2 for InputError, 1 for RuntimeFailure, 130 for Interrupted.
TEST(Errors, AreOneLineAndNotOfEachOthersType) {
  const InputError input("friction = -1", "demo.toml:12", "a number in [0, 10]");
  EXPECT_STREQ(input.what(), "friction = -1 (demo.toml:12): expected a number in [0, 10]");
  const std::runtime_error& base = input;
  EXPECT_EQ(dynamic_cast<const RuntimeFailure*>(&base), nullptr);
  EXPECT_EQ(dynamic_cast<const Interrupted*>(&base), nullptr);
  EXPECT_STREQ(RuntimeFailure("disk full").what(), "disk full");
  EXPECT_STREQ(Interrupted().what(), "interrupted");
}

}  // namespace
}  // namespace antigrasp
