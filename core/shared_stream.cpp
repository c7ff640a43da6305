#include "antigrasp/core/shared_stream.h"

#include <omp.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <map>
#include <mutex>
#include <thread>
#include <vector>

namespace antigrasp {
namespace {

constexpr std::int64_t kBeyondAll = std::int64_t{1} << 40;

// One loop, as rank 0 lays it down.
struct Loop {
  std::int64_t number = 0, count = 0;
  std::int64_t chunk = 1;   // items that are taken at once
  std::int64_t window = 1;  // items that somebody may be ahead of what is taken

  std::string Next() const { return "loop" + std::to_string(number); }
  std::string Taken() const { return Next() + "/taken"; }
  std::string Items(std::int64_t first) const { return Next() + "/" + std::to_string(first); }
  std::int64_t SizeOf(std::int64_t first) const { return std::min(chunk, count - first); }
};

// A small part of a thread's, so that all end at about one time, and no fewer than the store of
// some thousand threads has time for.
Loop LoopOf(WorkShare* share, std::int64_t count, int team) {
  Loop loop;
  loop.count = count;
  const std::int64_t threads = std::int64_t{team} * share->size();
  loop.chunk = std::clamp<std::int64_t>(count / (32 * threads), 1, 64);
  loop.window = 16 * threads * loop.chunk;
  if (share->leads()) loop.number = share->TakeNext("loops", 1);
  TellAll(share, &loop);
  if (loop.count == count) return loop;
  throw InputError("rank 0 has " + std::to_string(loop.count) + " of what this rank has " +
                       std::to_string(count),
                   "work that is shared", "the same inputs on all ranks");
}

void Nap() { std::this_thread::sleep_for(std::chrono::milliseconds(2)); }

// What the threads of a rank do; the first exception of any ends the others' taking.
class Team {
 public:
  Team(WorkShare* share, const Loop& loop, const std::function<std::string(std::int64_t)>& make)
      : share_(*share), loop_(loop), make_(make) {}
  virtual ~Team() = default;

  void Run(int threads) {
#pragma omp parallel num_threads(threads)
    {
      try {
        Work();
      } catch (...) {
        const std::lock_guard lock(mutex_);
        if (!error_) error_ = std::current_exception();
      }
    }
    if (error_) std::rethrow_exception(error_);
  }

 protected:
  virtual std::int64_t Taken() = 0;
  virtual void Give(std::int64_t first, std::vector<std::string> items) = 0;
  virtual void Pause() { Nap(); }  // too far ahead
  virtual void Finish() {}         // nothing is left to be made

  bool Stopped() {
    const std::lock_guard lock(mutex_);
    return error_ != nullptr;
  }

  WorkShare& share_;
  const Loop& loop_;
  std::mutex mutex_;  // guards what follows, here and below
  std::exception_ptr error_;

 private:
  void Work() {
    while (!Stopped()) {
      const std::int64_t first = share_.TakeNext(loop_.Next(), loop_.chunk);
      if (first >= loop_.count) return Finish();
      while (!Stopped() && first >= Taken() + loop_.window) Pause();
      std::vector<std::string> items;
      for (std::int64_t k = 0; k < loop_.SizeOf(first) && !Stopped(); ++k) {
        items.push_back(make_(first + k));
      }
      if (!Stopped()) Give(first, std::move(items));
    }
  }

  const std::function<std::string(std::int64_t)>& make_;
};

class Helpers final : public Team {
 public:
  using Team::Team;

 private:
  std::int64_t Taken() override { return share_.TakeNext(loop_.Taken(), 0); }
  void Give(std::int64_t first, std::vector<std::string> items) override {
    share_.Put(loop_.Items(first), PassedBytes(std::move(items)));
  }
};

// Rank 0: makes as the others do, and takes what all have made.
class Collector final : public Team {
 public:
  using TakeFn = std::function<void(std::int64_t, const std::string&)>;
  Collector(WorkShare* share, const Loop& loop,
            const std::function<std::string(std::int64_t)>& make, const TakeFn& take,
            const ProgressFn& progress)
      : Team(share, loop, make), take_(take), progress_(progress) {}
  // The others find nothing left, and nothing that is to be waited for.
  ~Collector() override {
    try {
      share_.TakeNext(loop_.Next(), kBeyondAll);
      share_.TakeNext(loop_.Taken(), kBeyondAll);
    } catch (const std::exception&) {  // the store is gone, and with it who would ask
    }
  }

 private:
  std::int64_t Taken() override {
    const std::lock_guard lock(mutex_);
    return taken_;
  }
  void Give(std::int64_t first, std::vector<std::string> items) override {
    {
      const std::lock_guard lock(mutex_);
      own_[first] = std::move(items);
    }
    TakeWhatIsThere();
  }
  void Pause() override {
    TakeWhatIsThere();
    Nap();
  }
  void Finish() override {
    while (!Stopped() && Taken() < loop_.count) Pause();
  }

  std::optional<std::vector<std::string>> Made(std::int64_t first) {
    {
      const std::lock_guard lock(mutex_);
      if (const auto own = own_.extract(first)) return std::move(own.mapped());
    }
    const std::optional<std::string> bytes = share_.TakeIfThere(loop_.Items(first));
    if (!bytes) return std::nullopt;
    auto items = FromPassed<std::vector<std::string>>(*bytes);
    if (std::ssize(items) == loop_.SizeOf(first)) return items;
    throw RuntimeFailure("another process sent " + std::to_string(items.size()) +
                         " results where there are " + std::to_string(loop_.SizeOf(first)));
  }

  // One thread at a time; another sees what is there later.
  void TakeWhatIsThere() {
    {
      const std::lock_guard lock(mutex_);
      if (taking_ || error_) return;
      taking_ = true;  // after an exception for good
    }
    while (taken_ < loop_.count) {
      const auto items = Made(taken_);
      if (!items) {
        if (progress_) progress_(taken_, loop_.count);  // hears Ctrl-C
        break;
      }
      for (std::int64_t k = 0; k < std::ssize(*items); ++k) {
        take_(taken_ + k, (*items)[static_cast<std::size_t>(k)]);
        if (progress_) progress_(taken_ + k + 1, loop_.count);
      }
      const std::lock_guard lock(mutex_);
      taken_ += std::ssize(*items);
      share_.TakeNext(loop_.Taken(), std::ssize(*items));
    }
    const std::lock_guard lock(mutex_);
    taking_ = false;
  }

  const TakeFn& take_;
  const ProgressFn& progress_;
  std::map<std::int64_t, std::vector<std::string>> own_;
  std::int64_t taken_ = 0;  // changed by the thread that takes
  bool taking_ = false;
};

}  // namespace

void ShareStream(WorkShare* share, std::int64_t count, int threads,
                 const std::function<std::string(std::int64_t)>& make,
                 const std::function<void(std::int64_t, const std::string&)>& take,
                 const ProgressFn& progress) {
  const int team = threads > 0 ? threads : HardwareThreads();
  const Loop loop = LoopOf(share, count, team);
  if (share->leads()) {
    Collector(share, loop, make, take, progress).Run(team);
  } else {
    Helpers(share, loop, make).Run(team);
  }
}

}  // namespace antigrasp
