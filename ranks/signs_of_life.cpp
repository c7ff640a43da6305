#include "antigrasp/ranks/signs_of_life.h"

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <utility>
#include <vector>

#include "antigrasp/core/launch.h"

namespace antigrasp {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kBeat(1000), kNap(50);
constexpr std::int64_t kGoodbye = std::int64_t{1} << 40;  // a beat that is none

std::string BeatOf(int rank) { return "beat/" + std::to_string(rank); }

[[noreturn]] void End(const std::string& why) {
  std::fprintf(stderr, "%s: %s; what was saved stays\n", Speaker().c_str(), why.c_str());
  std::fflush(stderr);
  std::_Exit(1);
}

}  // namespace

SignsOfLife::SignsOfLife(c10::intrusive_ptr<c10d::Store> store, int rank, int size,
                         double lost_after_seconds)
    : store_(std::move(store)), rank_(rank), size_(size), lost_after_(lost_after_seconds) {
  store_->add(BeatOf(rank_), 1);  // from here on it is missed
  thread_ = std::thread([this] { Run(); });
}

SignsOfLife::~SignsOfLife() {
  stop_ = true;
  thread_.join();
}

void SignsOfLife::Run() {
  struct Seen {
    std::int64_t beats = -1;
    Clock::time_point when = Clock::now();
  };
  std::vector<Seen> seen(static_cast<std::size_t>(size_));
  try {
    while (!stop_) {
      store_->add(BeatOf(rank_), 1);
      for (int other = 0; other < size_; ++other) {
        Seen& last = seen[static_cast<std::size_t>(other)];
        const std::int64_t beats = store_->add(BeatOf(other), 0);
        const bool unheard = beats == 0;
        if (beats != last.beats || unheard || beats >= kGoodbye) last = {beats, Clock::now()};
        const std::chrono::duration<double> silent = Clock::now() - last.when;
        if (silent.count() > lost_after_) {
          End("rank " + std::to_string(other) + " is gone: no sign of it for " +
              std::to_string(static_cast<int>(silent.count())) + " s");
        }
      }
      for (auto waited = Clock::duration::zero(); waited < kBeat && !stop_; waited += kNap) {
        std::this_thread::sleep_for(kNap);
      }
    }
    store_->add(BeatOf(rank_), kGoodbye);
  } catch (const std::exception&) {
    // The store is gone with rank 0; at the end of a job that is no news.
    if (!stop_) End("rank 0 is gone");
  }
}

}  // namespace antigrasp
