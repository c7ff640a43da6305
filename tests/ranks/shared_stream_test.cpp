// Loops that the ranks of a job share, the ranks being threads.
#include "antigrasp/core/shared_stream.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "antigrasp/core/exit_code.h"
#include "antigrasp/core/launch.h"
#include "antigrasp/ranks/ranked_share.h"
#include "tests/ranks/fake_group.h"

namespace antigrasp {
namespace {

void Nap() { std::this_thread::sleep_for(std::chrono::milliseconds(1)); }

// As a command is run.
void RunAll(int ranks, const std::function<void(RankedShare*)>& run) {
  ThreadRanks(ranks).Run([&](RankGroup* group) {
    RankedShare share(group);
    try {
      run(&share);
    } catch (const WorkOver&) {
    } catch (const std::exception&) {
      try {
        share.LeaveWith(std::current_exception());
      } catch (const std::exception&) {
      }
    }
  });
}

TEST(SharedStream, RankZeroTakesEveryItemOnceInOrderForAnyNumberOfRanksAndThreads) {
  for (const int ranks : {1, 2, 3}) {
    for (const int threads : {1, 2}) {
      std::string taken;
      std::atomic<int> made{0};
      RunAll(ranks, [&](RankedShare* share) {
        StreamShared(
            share, 200, threads,
            [&](std::int64_t i) {
              ++made;
              return "item " + std::to_string(i);
            },
            [&](std::int64_t i, const std::string& item) {
              EXPECT_TRUE(share->leads());
              EXPECT_EQ(item, "item " + std::to_string(i));
              taken += std::to_string(i) + " ";
            });
      });
      std::string all;
      for (int i = 0; i < 200; ++i) all += std::to_string(i) + " ";
      EXPECT_EQ(taken, all) << ranks;
      EXPECT_EQ(made, 200) << ranks;
    }
  }
}

TEST(SharedStream, EveryRankMakesItemsAndReturnsWhenNoneIsLeft) {
  std::atomic<int> of_others{0};
  std::atomic<bool> both{false};
  int returned = 0, taken = 0;
  RunAll(3, [&](RankedShare* share) {
    std::atomic<int> own{0};
    StreamShared(
        share, 60, 1,
        [&](std::int64_t i) {
          // All go on when both others make one.
          if (!share->leads() && own++ == 0 && ++of_others == 2) both = true;
          while (!both) Nap();
          return i;
        },
        [&](std::int64_t, std::int64_t) { ++taken; });
    if (share->leads()) returned = taken;
  });
  EXPECT_EQ(returned, 60);
}

TEST(SharedStream, LoopsFollowEachOtherAndOthersAreToldWhatTheNextDependsOn) {
  std::vector<double> sums;
  std::atomic<int> ended{0};
  RunAll(3, [&](RankedShare* share) {
    std::vector<double> values;
    StreamShared(
        share, 5, 1, [](std::int64_t i) { return double(i); },
        [&](std::int64_t, double value) { values.push_back(value); });
    TellAll(share, &values);
    StreamShared(
        share, std::ssize(values), 1,
        [&](std::int64_t i) { return 10.0 * values[static_cast<std::size_t>(i)]; },
        [&](std::int64_t, double value) { sums.push_back(value); });
    ++ended;
  });
  EXPECT_EQ(sums, (std::vector<double>{0.0, 10.0, 20.0, 30.0, 40.0}));
  EXPECT_EQ(ended, 3);
}

TEST(SharedStream, WhatAnotherRankFailsWithLeavesOnRankZeroInTheSameWords) {
  for (const bool input : {true, false}) {
    std::atomic<bool> failed{false};
    std::string line;
    RunAll(2, [&](RankedShare* share) {
      const auto make = [&](std::int64_t i) {
        if (!share->leads()) {
          failed = true;
          if (input) throw InputError("is cut short", "mug.h5", "a whole file");
          throw RuntimeFailure("the disk is full");
        }
        while (!failed) Nap();
        return i;
      };
      try {
        StreamShared(share, 40, 1, make, [](std::int64_t, std::int64_t) {});
      } catch (const InputError& error) {
        if (share->leads()) line = std::string("input: ") + error.what();
        throw;
      } catch (const RuntimeFailure& error) {
        if (share->leads()) line = std::string("failure: ") + error.what();
        throw;
      }
    });
    const std::string rank = "rank 1 on " + HostName() + ": ";
    EXPECT_EQ(line, input ? "input: " + rank + "is cut short (mug.h5): expected a whole file"
                          : "failure: " + rank + "the disk is full");
  }
}

// What each rank says, "" for nothing, and its exit code.
std::vector<std::string> Said(const std::function<void(RankedShare*)>& run) {
  std::vector<std::string> said(3);
  ThreadRanks(3).Run([&](RankGroup* group) {
    RankedShare share(group);
    std::string& own = said[static_cast<std::size_t>(group->rank())];
    try {
      try {
        run(&share);
      } catch (const WorkOver&) {
      } catch (...) {
        share.LeaveWith(std::current_exception());
      }
    } catch (const SaidElsewhere& elsewhere) {
      own = " " + std::to_string(elsewhere.exit_code());
    } catch (const std::exception& error) {
      own = error.what() + (" " + std::to_string(ExitCodeOf(std::current_exception())));
    }
  });
  return said;
}

TEST(LeaveWith, WhatAllFailWithIsSaidByRankZeroAlone) {
  const auto missing = [](RankedShare* share) {
    while (share->leads() && share->TakeNext("failed", 0) < 2) Nap();  // the last to see it
    throw InputError("no file", "mug.h5", "one");
  };
  EXPECT_EQ(Said(missing),
            (std::vector<std::string>{"no file (mug.h5): expected one 2", " 2", " 2"}));
}

TEST(LeaveWith, WhatOneFailsWithIsSaidByRankZeroWhereItHears) {
  const auto run = [](RankedShare* share) {
    if (share->rank() == 1) throw RuntimeFailure("no memory");
    StreamShared(
        share, 1, 1,
        [&](std::int64_t i) {
          while (share->TakeNext("failed", 0) == 0) Nap();
          return i;
        },
        [](std::int64_t, std::int64_t) {});
    if (share->leads()) share->TakeIfThere("what never comes");
  };
  EXPECT_EQ(Said(run),
            (std::vector<std::string>{"rank 1 on " + HostName() + ": no memory 1", " 1", ""}));
}

TEST(LeaveWith, ARankThatRankZeroDoesNotHearSpeaksForItself) {
  std::atomic<bool> said{false};
  ThreadRanks(2).Run([&](RankGroup* group) {
    RankedShare share(group);
    try {
      if (share.leads()) {
        while (!said) Nap();
        throw SaidElsewhere(1);  // a call to the other has failed
      }
      throw InputError("no file", "mug.h5", "one");
    } catch (...) {
      const std::exception_ptr error = std::current_exception();
      try {
        share.LeaveWith(error);
      } catch (const SaidElsewhere& elsewhere) {
        EXPECT_TRUE(share.leads());
        EXPECT_EQ(elsewhere.exit_code(), 2);  // that of the other
      } catch (const InputError&) {
        EXPECT_FALSE(share.leads());
        said = true;
      }
    }
  });
  EXPECT_TRUE(said);
}

TEST(SharedStream, AnExceptionOnRankZeroEndsTheOthersAtTheNextLoop) {
  std::atomic<int> over{0}, made{0};
  RunAll(3, [&](RankedShare* share) {
    try {
      StreamShared(
          share, 1000, 1,
          [&](std::int64_t i) {
            ++made;
            Nap();
            return i;
          },
          [](std::int64_t i, std::int64_t) {
            if (i == 5) throw Interrupted();
          });
      int nothing = 0;
      TellAll(share, &nothing);
    } catch (const WorkOver&) {
      ++over;
    }
  });
  EXPECT_EQ(over, 2);
  EXPECT_LT(made, 1000);
}

TEST(SharedStream, ProgressIsThatOfRankZeroAndEndsTheWork) {
  std::vector<std::int64_t> done;
  std::atomic<int> over{0};
  RunAll(2, [&](RankedShare* share) {
    try {
      StreamShared(
          share, 50, 1, [](std::int64_t i) { return i; }, [](std::int64_t, std::int64_t) {},
          [&](std::int64_t now, std::int64_t total) {
            EXPECT_TRUE(share->leads());
            EXPECT_EQ(total, 50);
            done.push_back(now);
          });
    } catch (const WorkOver&) {
      ++over;
    }
  });
  EXPECT_EQ(done.back(), 50);
  EXPECT_TRUE(std::is_sorted(done.begin(), done.end()));
}

// 500 items of two ranks with a thread each: 7 at once, 16 times 14 ahead.
TEST(SharedStream, NobodyRunsFarAheadOfWhatIsTaken) {
  std::atomic<int> of_other{0};
  int seen = 0;
  RunAll(2, [&](RankedShare* share) {
    StreamShared(
        share, 500, 1,
        [&](std::int64_t i) {
          if (!share->leads()) ++of_other;
          while (share->leads() && of_other < 200) Nap();
          return i;
        },
        [&](std::int64_t i, std::int64_t) {
          if (i > 0) return;
          std::this_thread::sleep_for(std::chrono::milliseconds(50));
          seen = of_other;
        });
  });
  EXPECT_GE(seen, 200);
  EXPECT_LE(seen, 224);
}

TEST(SharedStream, ARankOfOtherInputsIsRefused) {
  std::string line;
  int taken = 0;
  RunAll(2, [&](RankedShare* share) {
    try {
      StreamShared(
          share, share->leads() ? 30 : 29, 1, [](std::int64_t i) { return i; },
          [&](std::int64_t, std::int64_t) { ++taken; });
    } catch (const InputError& error) {
      if (!share->leads()) line = error.what();
    }
  });
  EXPECT_EQ(taken, 30);
  EXPECT_EQ(line,
            "rank 0 has 30 of what this rank has 29 (work that is shared): expected the same "
            "inputs on all ranks");
}

TEST(SharedStream, ResultsOfAnotherNumberAreRefused) {
  std::atomic<bool> put{false};
  ThreadRanks(2).Run([&](RankGroup* group) {
    if (!group->leads()) {
      EXPECT_EQ(group->Wait("told/1/0").front(), 'T');
      const std::int64_t first = group->TakeNext("loop0", 1);
      EXPECT_LT(first, 3);
      group->Put("loop0/" + std::to_string(first), PassedBytes(std::vector<std::string>{"a", "b"}));
      put = true;
      group->TakeNext("left", 1);
      return;
    }
    RankedShare share(group);
    const auto make = [&](std::int64_t i) {
      while (!put) Nap();
      return i;
    };
    EXPECT_THROW(StreamShared(&share, 3, 1, make, [](std::int64_t, std::int64_t) {}),
                 RuntimeFailure);
  });
}

}  // namespace
}  // namespace antigrasp
