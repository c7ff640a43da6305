#include "antigrasp/ranks/signs_of_life.h"

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <utility>

#include "antigrasp/ranks/rank_group.h"

namespace antigrasp {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kBeat(1000), kNap(50);
constexpr std::int64_t kGoodbye = std::int64_t{1} << 40;  // a beat that is none
// Once a connection has broken, as long a silence is enough.
constexpr double kInDoubt = 5.0;
constexpr double kHearingSeconds = 3.0;

constexpr const char *kGone = "gone", *kHeard = "heard", *kDoubt = "doubt";

std::string BeatOf(int rank) { return "beat/" + std::to_string(rank); }

double Since(Clock::time_point when) {
  return std::chrono::duration<double>(Clock::now() - when).count();
}

std::string Gone(int rank, double silent) {
  return "rank " + std::to_string(rank) + " is gone: no sign of it for " +
         std::to_string(static_cast<int>(silent)) + " s; what was saved stays";
}

}  // namespace

void TellThatItEnds(c10d::Store* store, const std::string& line, int others) {
  if (store->add(RankGroup::CounterKey(kSaid), 1) == 1) SayOfRank(line);
  store->set(kGone, {1});
  const auto start = Clock::now();
  while (store->add(kHeard, 0) < others && Since(start) < kHearingSeconds) {
    std::this_thread::sleep_for(kNap);
  }
}

SignsOfLife::SignsOfLife(c10::intrusive_ptr<c10d::Store> store, const Launch& launch)
    : store_(std::move(store)), launch_(launch) {
  for (int other = launch.leads() ? 1 : 0; other < (launch.leads() ? launch.size : 1); ++other) {
    watched_.push_back({other});
  }
  beats_ = std::thread([this] { Run(); });
  const bool has_store = launch.leads() && !launch.store_is_there;
  if (!has_store) watch_ = std::thread([this] { WatchStore(); });
}

SignsOfLife::~SignsOfLife() {
  SayGoodbye();
  beats_.join();
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
  }
  changed_.notify_all();
  if (watch_.joinable()) watch_.join();
}

void SignsOfLife::SayGoodbye() {
  const std::lock_guard lock(mutex_);
  stop_ = true;
  changed_.notify_all();
}

void SignsOfLife::LetLeave() {
  const std::lock_guard lock(mutex_);
  may_leave_ = true;
}

bool SignsOfLife::FindWhoIsGone() {
  std::unique_lock lock(mutex_);
  asked_ = true;
  changed_.notify_all();
  changed_.wait_for(lock, std::chrono::duration<double>(launch_.lost_after),
                    [&] { return known_; });
  return known_;
}

bool SignsOfLife::Is(const bool& flag) {
  const std::lock_guard lock(mutex_);
  return flag;
}

void SignsOfLife::Run() {
  try {
    while (!Is(stop_) && !Is(known_)) {
      Beat();
      Look();
      Rest();
    }
    if (!Is(known_)) store_->add(BeatOf(launch_.rank), kGoodbye);
  } catch (const std::exception&) {
    // The store is gone with whoever has it; at the end of a job that is no news.
    if (Is(stop_)) return;
    const std::string keeper = launch_.store_is_there ? "the launcher" : "rank 0";
    SayOfRank(keeper + " is gone; what was saved stays");
    End();
  }
}

void SignsOfLife::Beat() {
  store_->add(BeatOf(launch_.rank), 1);
  if (Is(asked_) && !std::exchange(told_doubt_, true)) store_->add(kDoubt, 1);
  const std::lock_guard lock(mutex_);
  answered_ = Clock::now();
}

// Whether the others live, as far as this rank is to know.
void SignsOfLife::Look() {
  const bool in_doubt = store_->add(kDoubt, 0) > 0;
  int living = 0;
  std::string gone;
  for (Watched& other : watched_) {
    const std::int64_t beats = store_->add(BeatOf(other.rank), 0);
    if (beats != other.beats) other = {other.rank, beats};
    const std::string why = WhyGone(other, in_doubt);
    if (gone.empty()) gone = why;
    living += why.empty() && beats > 0 && beats < kGoodbye ? 1 : 0;
  }
  if (!gone.empty()) {
    TellThatItEnds(store_.get(), gone, launch_.leads() ? living : 0);
    End();
  } else if (!launch_.leads() && store_->check({kGone})) {
    store_->add(kHeard, 1);
    End();
  }
}

// Empty of one that lives, has left, or may be on its way: rank 0 waits for those itself.
std::string SignsOfLife::WhyGone(const Watched& other, bool in_doubt) {
  if (other.beats >= kGoodbye) {
    const bool left = Is(may_leave_) && !in_doubt;
    return left ? "" : "rank " + std::to_string(other.rank) + " has ended before the others";
  }
  if (other.beats == 0 && launch_.leads()) return "";
  const double silent = Since(other.changed);
  const double least = other.beats == 0 ? launch_.FirstWait()
                       : in_doubt       ? std::min(kInDoubt, 0.5 * launch_.lost_after)
                                        : launch_.lost_after;
  return silent > least ? Gone(other.rank, silent) : "";
}

void SignsOfLife::Rest() {
  std::unique_lock lock(mutex_);
  const bool hurry = asked_;
  changed_.wait_for(lock, hurry ? kNap : kBeat, [&] { return stop_ || known_ || asked_ != hurry; });
}

// A store on a machine that is gone, or in a process that stands still, does not even fail.
void SignsOfLife::WatchStore() {
  std::unique_lock lock(mutex_);
  while (!ended_) {
    const double silent = Since(answered_);
    if (silent > launch_.lost_after && !known_) {
      SayOfRank(Gone(0, silent));
      std::_Exit(1);
    }
    changed_.wait_for(lock, kBeat, [&] { return ended_; });
  }
}

// Whoever asked ends in order; nobody else can be reached where they are.
void SignsOfLife::End() {
  const std::lock_guard lock(mutex_);
  if (!asked_) std::_Exit(1);
  known_ = true;
  changed_.notify_all();
}

}  // namespace antigrasp
