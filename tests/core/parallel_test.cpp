#include "antigrasp/core/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <numeric>
#include <vector>

#include "antigrasp/core/error.h"

namespace antigrasp {
namespace {

TEST(ParallelFor, VisitsEveryIndexOnceForAnyNumberOfThreads) {
  for (const int threads : {0, 1, 2, 5}) {
    std::vector<int> visits(1000);
    ParallelFor(1000, threads, [&](std::int64_t i) { ++visits[static_cast<std::size_t>(i)]; });
    EXPECT_EQ(visits, std::vector<int>(1000, 1)) << threads << " threads";
  }
}

TEST(ParallelFor, ReportsProgressUpToTheTotal) {
  std::vector<std::int64_t> reported;
  ParallelFor(
      50, 2, [](std::int64_t) {},
      [&](std::int64_t done, std::int64_t total) {
        EXPECT_EQ(total, 50);
        reported.push_back(done);
      });
  std::vector<std::int64_t> expected(50);
  std::iota(expected.begin(), expected.end(), 1);
  EXPECT_EQ(reported, expected);
}

TEST(ParallelFor, RethrowsTheBodysExceptionAndStopsHandingOutWork) {
  std::atomic<int> ran{0};
  EXPECT_THROW(ParallelFor(100000, 2,
                           [&](std::int64_t) {
                             ++ran;
                             throw InputError("x", "y", "z");
                           }),
               InputError);
  EXPECT_LE(ran, 2);
}

TEST(ParallelFor, LetsAProgressCallbackInterrupt) {
  EXPECT_THROW(ParallelFor(
                   100, 2, [](std::int64_t) {},
                   [](std::int64_t done, std::int64_t) {
                     if (done == 3) throw Interrupted();
                   }),
               Interrupted);
}

TEST(ParallelFor, DoesNothingForAnEmptyRange) {
  ParallelFor(0, 2, [](std::int64_t) { FAIL(); });
}

}  // namespace
}  // namespace antigrasp
