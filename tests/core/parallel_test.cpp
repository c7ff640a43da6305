#include "antigrasp/core/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <numeric>
#include <string>
#include <thread>
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
  ParallelFor(-1, 2, [](std::int64_t) { FAIL(); });
}

TEST(ParallelFor, OneThreadIsTheCallersInOrder) {
  std::vector<std::int64_t> order(200);
  std::atomic<std::size_t> place{0};
  const std::thread::id caller = std::this_thread::get_id();
  ParallelFor(200, 1, [&](std::int64_t i) {
    EXPECT_EQ(std::this_thread::get_id(), caller);
    order[place++] = i;
  });
  std::vector<std::int64_t> expected(200);
  std::iota(expected.begin(), expected.end(), 0);
  EXPECT_EQ(order, expected);
}

// Every item waits until all three are there: fewer threads would never get that far.
TEST(ParallelFor, RunsAsManyAtATimeAsItIsTold) {
  std::mutex mutex;
  std::condition_variable arrived;
  int here = 0;
  ParallelFor(3, 3, [&](std::int64_t) {
    std::unique_lock<std::mutex> lock(mutex);
    ++here;
    arrived.notify_all();
    EXPECT_TRUE(arrived.wait_for(lock, std::chrono::seconds(60), [&] { return here == 3; }));
  });
  EXPECT_GE(HardwareThreads(), 1);
}

TEST(ParallelFor, ProgressComesAfterItsItem) {
  std::atomic<int> finished{0};
  ParallelFor(
      50, 2, [&](std::int64_t) { ++finished; },
      [&](std::int64_t done, std::int64_t) { EXPECT_GE(finished, done); });
}

TEST(ParallelFor, TheFirstExceptionIsTheOneThatLeaves) {
  std::atomic<int> ran{0};
  try {
    ParallelFor(100, 1, [&](std::int64_t i) {
      ++ran;
      if (i >= 3) throw InputError("item " + std::to_string(i), "here", "fewer");
    });
    FAIL() << "nothing thrown";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "item 3 (here): expected fewer");
  }
  EXPECT_EQ(ran, 4);
}

}  // namespace
}  // namespace antigrasp
