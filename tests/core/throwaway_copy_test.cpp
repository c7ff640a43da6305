#include "antigrasp/core/throwaway_copy.h"

#include <gtest/gtest.h>

#include <csignal>
#include <stdexcept>

namespace antigrasp {
namespace {

TEST(ReturnsInACopy, TellsWorkThatEndsFromWorkThatDiesOrTakesTooLong) {
  EXPECT_TRUE(ReturnsInACopy([] {}, 5));
  EXPECT_TRUE(ReturnsInACopy([] { throw std::runtime_error("refused"); }, 5));
  EXPECT_FALSE(ReturnsInACopy([] { std::raise(SIGSEGV); }, 5));
  EXPECT_FALSE(ReturnsInACopy([] { std::raise(SIGABRT); }, 5));
  EXPECT_FALSE(ReturnsInACopy(
      [] {
        for (volatile bool go_on = true; go_on;) {
        }
      },
      1));
}

TEST(ReturnsInACopy, LeavesNothingOfTheWork) {
  int number = 1;
  EXPECT_TRUE(ReturnsInACopy([&] { number = 2; }, 5));
  EXPECT_EQ(number, 1);
}

}  // namespace
}  // namespace antigrasp
