#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include <torch/csrc/distributed/c10d/Store.hpp>

#include "antigrasp/core/launch.h"

namespace antigrasp {

// Tells rank 0 every second that this rank lives, and ends this process (exit code 1) when it is
// known that one is gone: whoever waits for a dead one would wait for ever. Rank 0 watches all, the
// others rank 0 and what it says, so that one line names one rank. What a run has saved stays.
class SignsOfLife {
 public:
  // `store`: a connection of its own, which nobody else uses.
  SignsOfLife(c10::intrusive_ptr<c10d::Store> store, const Launch& launch);
  ~SignsOfLife();  // says goodbye
  SignsOfLife(const SignsOfLife&) = delete;
  SignsOfLife& operator=(const SignsOfLife&) = delete;

  // From here on a rank that has said goodbye is not missed: the end of a job.
  void LetLeave();

  // Nobody is missed any more.
  void SayGoodbye();

  // For a thread whose call to another rank has failed: waits until it is known who is gone, some
  // seconds where a silence shows it. True where that has been said: this process ends without a
  // line of its own.
  bool FindWhoIsGone();

 private:
  using Clock = std::chrono::steady_clock;
  struct Watched {
    int rank = 0;
    std::int64_t beats = -1;
    Clock::time_point changed = Clock::now();
  };

  void Run();
  void WatchStore();
  void Beat();
  void Look();
  std::string WhyGone(const Watched& other, bool in_doubt);
  void Rest();
  void End();
  bool Is(const bool& flag);

  c10::intrusive_ptr<c10d::Store> store_;
  Launch launch_;
  std::vector<Watched> watched_;
  bool told_doubt_ = false;

  std::mutex mutex_;  // guards what follows
  std::condition_variable changed_;
  bool stop_ = false, asked_ = false, known_ = false, may_leave_ = false, ended_ = false;
  Clock::time_point answered_ = Clock::now();  // by the store

  std::thread beats_, watch_;
};

// Says `line`, lets the other ranks end without one of theirs, and waits until `others` of them
// have heard it, a few seconds at most: `store` ends with rank 0.
void TellThatItEnds(c10d::Store* store, const std::string& line, int others);

}  // namespace antigrasp
