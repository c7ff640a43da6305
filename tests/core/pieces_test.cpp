#include "antigrasp/core/pieces.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "antigrasp/core/error.h"

namespace antigrasp {
namespace {

// As many threads as a test asks for, and as many as before at its end.
class Pieces : public testing::Test {
 protected:
  ~Pieces() override { SetPieceThreads(before_); }
  const int before_ = PieceThreads();
};

TEST_F(Pieces, EachIsDoneOnceForAnyNumberOfThreads) {
  for (const int threads : {1, 2, 5, 3}) {
    SetPieceThreads(threads);
    EXPECT_EQ(PieceThreads(), threads);
    for (int loop = 0; loop < 200; ++loop) {
      std::vector<int> visits(loop);
      ForPieces(loop, [&](std::int64_t i) { ++visits[static_cast<std::size_t>(i)]; });
      EXPECT_EQ(visits, std::vector<int>(loop, 1)) << threads << " threads";
    }
  }
}

TEST_F(Pieces, RangesCoverAllWithoutOverlapAndTheLastIsShorter) {
  SetPieceThreads(2);
  std::mutex mutex;
  std::set<std::array<std::int64_t, 2>> ranges;
  ForRanges(10, 4, [&](std::int64_t begin, std::int64_t end) {
    const std::lock_guard<std::mutex> lock(mutex);
    ranges.insert({begin, end});
  });
  EXPECT_EQ(ranges, (std::set<std::array<std::int64_t, 2>>{{0, 4}, {4, 8}, {8, 10}}));
  ForRanges(0, 4, [](std::int64_t, std::int64_t) { FAIL(); });
}

// Every piece waits until all three are there: fewer threads would never get that far.
TEST_F(Pieces, AsManyRunAtATimeAsThereAreThreads) {
  SetPieceThreads(3);
  for (int loop = 0; loop < 20; ++loop) {
    std::mutex mutex;
    std::condition_variable arrived;
    int here = 0;
    ForPieces(3, [&](std::int64_t) {
      std::unique_lock<std::mutex> lock(mutex);
      ++here;
      arrived.notify_all();
      EXPECT_TRUE(arrived.wait_for(lock, std::chrono::seconds(60), [&] { return here == 3; }));
    });
  }
}

// The thread that has one piece waits for all others: a fixed share of them would never be done.
TEST_F(Pieces, AThreadThatIsHeldUpHoldsUpItsOwnPieceOnly) {
  SetPieceThreads(2);
  std::mutex mutex;
  std::condition_variable changed;
  int done = 0;
  ForPieces(50, [&](std::int64_t i) {
    std::unique_lock<std::mutex> lock(mutex);
    if (i == 0) {
      EXPECT_TRUE(changed.wait_for(lock, std::chrono::seconds(60), [&] { return done == 49; }));
    }
    ++done;
    changed.notify_all();
  });
  EXPECT_EQ(done, 50);
}

TEST_F(Pieces, SleepersAreWokenForTheNextLoop) {
  SetPieceThreads(2);
  for (int loop = 0; loop < 3; ++loop) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));  // long past looking
    std::mutex mutex;
    std::condition_variable arrived;
    int here = 0;
    ForPieces(2, [&](std::int64_t) {
      std::unique_lock<std::mutex> lock(mutex);
      ++here;
      arrived.notify_all();
      EXPECT_TRUE(arrived.wait_for(lock, std::chrono::seconds(60), [&] { return here == 2; }));
    });
  }
}

TEST_F(Pieces, TheFirstExceptionLeavesAndTheNextLoopIsWhole) {
  SetPieceThreads(2);
  std::atomic<int> ran{0};
  EXPECT_THROW(ForPieces(100000,
                         [&](std::int64_t) {
                           ++ran;
                           throw InputError("x", "y", "z");
                         }),
               InputError);
  EXPECT_LE(ran, 2);
  ran = 0;
  ForPieces(100, [&](std::int64_t) { ++ran; });
  EXPECT_EQ(ran, 100);
}

TEST_F(Pieces, OfAPieceRunOnItsOwnThread) {
  SetPieceThreads(3);
  std::atomic<int> ran{0};
  ForPieces(6, [&](std::int64_t) {
    const std::thread::id outer = std::this_thread::get_id();
    ForPieces(10, [&](std::int64_t) {
      EXPECT_EQ(std::this_thread::get_id(), outer);
      ++ran;
    });
  });
  EXPECT_EQ(ran, 60);
}

TEST_F(Pieces, OfManyCallersAreAllDone) {
  SetPieceThreads(3);
  std::array<std::atomic<int>, 4> ran{};
  std::vector<std::thread> callers;
  for (std::atomic<int>& own : ran) {
    callers.emplace_back([&own] {
      for (int loop = 0; loop < 100; ++loop) ForPieces(10, [&](std::int64_t) { ++own; });
    });
  }
  for (std::thread& caller : callers) caller.join();
  for (const std::atomic<int>& own : ran) EXPECT_EQ(own, 1000);
}

TEST_F(Pieces, ACopyOfTheProcessDoesThemAlone) {
  SetPieceThreads(2);
  ForPieces(100, [](std::int64_t) {});  // its threads are there, and are not in the copy
  const pid_t copy = fork();
  if (copy == 0) {
    int ran = 0;
    ForPieces(100, [&](std::int64_t) { ++ran; });
    _exit(ran == 100 ? 0 : 1);
  }
  int status = -1;
  ASSERT_EQ(waitpid(copy, &status, 0), copy);
  EXPECT_EQ(status, 0);
}

}  // namespace
}  // namespace antigrasp
