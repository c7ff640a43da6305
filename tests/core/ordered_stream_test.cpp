#include "antigrasp/core/ordered_stream.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <stdexcept>
#include <thread>

namespace antigrasp {
namespace {

void Rest(std::int64_t item) { std::this_thread::sleep_for(std::chrono::microseconds(item % 7)); }

TEST(OrderedStream, TakesEveryItemOnceInOrderForAnyNumberOfThreads) {
  for (const int threads : {1, 2, 5}) {
    std::vector<std::int64_t> taken;
    StreamInOrder(
        100, threads,
        [](std::int64_t i) {
          Rest(100 - i);  // later ones are done first
          return 3 * i;
        },
        [&](std::int64_t i, std::int64_t value) {
          EXPECT_EQ(value, 3 * i);
          taken.push_back(i);
        });
    ASSERT_EQ(taken.size(), 100U) << threads;
    for (std::int64_t i = 0; i < 100; ++i) EXPECT_EQ(taken[static_cast<std::size_t>(i)], i);
  }
}

TEST(OrderedStream, HoldsNoMoreItemsThanSlotsHoweverManyThereAre) {
  std::atomic<int> alive{0};
  std::atomic<int> most{0};
  struct Counted {
    explicit Counted(std::atomic<int>* alive) : alive_(alive) {}
    ~Counted() { --*alive_; }
    std::atomic<int>* alive_;
  };
  StreamInOrder(
      500, 3,
      [&](std::int64_t i) {
        const int now = ++alive;
        for (int seen = most; now > seen && !most.compare_exchange_weak(seen, now);) {
        }
        if (i == 40) std::this_thread::sleep_for(std::chrono::milliseconds(50));  // a slow one
        return std::make_unique<Counted>(&alive);
      },
      [](std::int64_t, std::unique_ptr<Counted>) {});
  EXPECT_EQ(alive, 0);
  EXPECT_GT(most, 3);  // the others went on while the slow one was made
  EXPECT_LE(most, static_cast<int>(SlotsOf(3)) + 1);  // and the one that is being taken
}

TEST(OrderedStream, StopsAtTheFirstExceptionAndTakesNothingBehindIt) {
  for (const int threads : {1, 4}) {
    std::vector<std::int64_t> taken;
    const auto make = [](std::int64_t i) {
      if (i == 20) throw std::runtime_error("twenty");
      return i;
    };
    const auto take = [&](std::int64_t i, std::int64_t) { taken.push_back(i); };
    EXPECT_THROW(StreamInOrder(1000, threads, make, take), std::runtime_error);
    EXPECT_LE(taken.size(), 20U);
    taken.clear();
    const auto refuse = [&](std::int64_t i, std::int64_t) {
      if (i == 5) throw std::runtime_error("five");
      taken.push_back(i);
    };
    EXPECT_THROW(StreamInOrder(
                     1000, threads, [](std::int64_t i) { return i; }, refuse),
                 std::runtime_error);
    EXPECT_EQ(taken, (std::vector<std::int64_t>{0, 1, 2, 3, 4}));
  }
}

TEST(OrderedStream, ReportsEveryItemInOrderAndProgressMayStopIt) {
  std::vector<std::int64_t> seen;
  const auto same = [](std::int64_t i) { return i; };
  const auto nothing = [](std::int64_t, std::int64_t) {};
  StreamInOrder(4, 2, same, nothing, [&](std::int64_t done, std::int64_t total) {
    seen.push_back(done);
    EXPECT_EQ(total, 4);
  });
  EXPECT_EQ(seen, (std::vector<std::int64_t>{1, 2, 3, 4}));
  EXPECT_THROW(StreamInOrder(4, 2, same, nothing,
                             [](std::int64_t, std::int64_t) { throw std::runtime_error("stop"); }),
               std::runtime_error);
  StreamInOrder(0, 2, same, nothing);  // nothing to do
}

}  // namespace
}  // namespace antigrasp
