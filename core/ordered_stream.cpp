#include "antigrasp/core/ordered_stream.h"

#include <omp.h>

#include <algorithm>
#include <condition_variable>
#include <exception>
#include <mutex>

namespace antigrasp {
namespace {

constexpr std::size_t kSlotsAThread = 4;  // so that one slow item does not stop the others

int TeamOf(int threads) { return threads > 0 ? threads : HardwareThreads(); }

// What the threads share. Items are handed out in order, so the one to be taken next is always done
// or in work: a thread that waits for a slot never waits for itself.
class Conveyor {
 public:
  using Body = std::function<void(std::int64_t, std::size_t)>;
  Conveyor(std::int64_t count, int threads, const Body& make, const Body& take,
           const ProgressFn& progress)
      : count_(count), ready_(SlotsOf(threads), 0), make_(make), take_(take), progress_(progress) {}

  // One thread's work, to the end or to the first exception of any.
  void Work() {
    std::unique_lock<std::mutex> lock(mutex_);
    while (true) {
      room_.wait(lock, [&] { return Finished() || handed_ - taken_ < Slots(); });
      if (Finished()) return;
      const std::int64_t item = handed_++;
      try {
        lock.unlock();
        make_(item, SlotOf(item));
        lock.lock();
        ready_[SlotOf(item)] = 1;
        TakeWhatIsReady(&lock);
      } catch (...) {
        if (!lock.owns_lock()) lock.lock();
        if (!error_) error_ = std::current_exception();
      }
      room_.notify_all();
    }
  }

  void Rethrow() const {
    if (error_) std::rethrow_exception(error_);
  }

 private:
  std::int64_t Slots() const { return std::ssize(ready_); }
  std::size_t SlotOf(std::int64_t item) const {
    return static_cast<std::size_t>(item % std::ssize(ready_));
  }
  bool Finished() const { return error_ || handed_ == count_; }

  void TakeWhatIsReady(std::unique_lock<std::mutex>* lock) {
    if (taking_) return;  // that thread will see what is ready
    taking_ = true;
    while (!error_ && taken_ < handed_ && ready_[SlotOf(taken_)] != 0) {
      lock->unlock();
      take_(taken_, SlotOf(taken_));
      if (progress_) progress_(taken_ + 1, count_);
      lock->lock();
      ready_[SlotOf(taken_)] = 0;
      ++taken_;
      room_.notify_all();
    }
    taking_ = false;
  }

  const std::int64_t count_;
  std::vector<char> ready_;  // by slot
  const Body& make_;
  const Body& take_;
  const ProgressFn& progress_;
  std::mutex mutex_;  // guards all that follows and `ready_`
  std::condition_variable room_;
  std::int64_t handed_ = 0, taken_ = 0;
  bool taking_ = false;  // after an exception of `take` for good: nothing is taken any more
  std::exception_ptr error_;
};

}  // namespace

std::size_t SlotsOf(int threads) {
  return kSlotsAThread * static_cast<std::size_t>(TeamOf(threads));
}

void OrderedStream(std::int64_t count, int threads,
                   const std::function<void(std::int64_t, std::size_t)>& make,
                   const std::function<void(std::int64_t, std::size_t)>& take,
                   const ProgressFn& progress) {
  if (count <= 0) return;
  const int team = static_cast<int>(std::min<std::int64_t>(count, TeamOf(threads)));
  Conveyor conveyor(count, threads, make, take, progress);
#pragma omp parallel num_threads(team)
  conveyor.Work();
  conveyor.Rethrow();
}

}  // namespace antigrasp
