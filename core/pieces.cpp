#include "antigrasp/core/pieces.h"

#include <unistd.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <limits>
#include <mutex>
#include <thread>
#include <vector>

#include "antigrasp/core/check.h"

namespace antigrasp {
namespace {

// Longer than the serial work between most loops, much shorter than a scheduler's slice.
constexpr std::chrono::microseconds kSpin{50};
constexpr int kLooksBetweenTimes = 64;

inline void Pause() {
#ifdef __x86_64__
  __builtin_ia32_pause();
#endif
}

// Whether `done` came true while it was looked at.
template <typename Done>
bool Spin(const Done& done) {
  const auto end = std::chrono::steady_clock::now() + kSpin;
  do {
    for (int i = 0; i < kLooksBetweenTimes; ++i) {
      if (done()) return true;
      Pause();
    }
  } while (std::chrono::steady_clock::now() < end);
  return done();
}

// A flag to wait for that costs no system call where nobody sleeps.
class Signal {
 public:
  template <typename Done>
  void Await(const Done& done) {
    if (Spin(done)) return;
    std::unique_lock<std::mutex> lock(mutex_);
    ++sleepers_;
    changed_.wait(lock, done);
    --sleepers_;
  }
  // After what makes `done` true. Sequentially consistent with the sleeper's look behind
  // ++sleepers_.
  void Notify() {
    if (sleepers_.load() == 0) return;
    const std::lock_guard<std::mutex> lock(mutex_);
    changed_.notify_all();
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::atomic<int> sleepers_{0};
};

// Pieces [begin, end) of which a thread takes the first and the others the last: what it did in the
// loop before is in its caches.
class alignas(64) Share {
 public:
  void Set(std::uint32_t begin, std::uint32_t end) { range_ = Packed(begin, end); }
  bool TakeFirst(std::int64_t* piece) {
    return Take([&](std::uint32_t* begin, std::uint32_t*) { *piece = (*begin)++; });
  }
  bool TakeLast(std::int64_t* piece) {
    return Take([&](std::uint32_t*, std::uint32_t* end) { *piece = --(*end); });
  }

 private:
  static std::uint64_t Packed(std::uint32_t begin, std::uint32_t end) {
    return std::uint64_t{begin} << 32 | end;
  }
  template <typename Change>
  bool Take(const Change& change) {
    std::uint64_t seen = range_;
    while (true) {
      auto begin = static_cast<std::uint32_t>(seen >> 32), end = static_cast<std::uint32_t>(seen);
      if (begin >= end) return false;
      change(&begin, &end);
      if (range_.compare_exchange_weak(seen, Packed(begin, end))) return true;
    }
  }

  std::atomic<std::uint64_t> range_{0};
};

// A loop is open or closed; helpers may enter while it is open, and its owner leaves it when it is
// closed and empty. One word holds all: the number of the loop, whether it is open, who is inside.
class Pool {
 public:
  static Pool& Get() {
    static Pool* const pool = new Pool;  // its threads sleep until the process ends
    return *pool;
  }

  void SetThreads(int threads) { wanted_ = std::max(1, threads); }
  int threads() const { return wanted_; }

  bool Take() { return getpid() == process_ && !taken_.test_and_set(std::memory_order_acquire); }
  void GiveBack() { taken_.clear(std::memory_order_release); }

  void Run(std::int64_t count, const std::function<void(std::int64_t)>& body) {
    AG_CHECK(count <= std::numeric_limits<std::uint32_t>::max(), "pieces are numbered in 32 bits");
    const std::int64_t threads = wanted_;
    if (std::ssize(shares_) != threads) shares_ = std::vector<Share>(threads);
    for (; started_ < shares_.size(); ++started_) {
      std::thread([this, own = started_] { Help(own); }).detach();
    }
    for (std::int64_t i = 0; i < threads; ++i) {
      shares_[i].Set(static_cast<std::uint32_t>(i * count / threads),
                     static_cast<std::uint32_t>((i + 1) * count / threads));
    }
    body_ = &body;
    error_ = nullptr;
    failed_ = false;
    state_ += kLoop + kOpen;  // it was closed and empty
    opened_.Notify();
    Work(0);
    state_ -= kOpen;
    emptied_.Await([this] { return (state_ & kInside) == 0; });
    if (error_) std::rethrow_exception(error_);
  }

 private:
  static constexpr std::uint64_t kOpen = 1 << 16, kInside = kOpen - 1, kLoop = kOpen << 1;

  bool Next(std::size_t own, std::int64_t* piece) {
    if (shares_[own].TakeFirst(piece)) return true;
    for (std::size_t i = 1; i < shares_.size(); ++i) {
      if (shares_[(own + i) % shares_.size()].TakeLast(piece)) return true;
    }
    return false;
  }

  void Work(std::size_t own) {
    for (std::int64_t piece = 0; !failed_ && Next(own, &piece);) {
      try {
        (*body_)(piece);
      } catch (...) {
        const std::lock_guard<std::mutex> lock(error_mutex_);
        if (!error_) error_ = std::current_exception();
        failed_ = true;
      }
    }
  }

  // Once a loop at most: its pieces are handed out when this thread leaves it.
  void Help(std::size_t own) {
    std::uint64_t last = 0;
    while (true) {
      std::uint64_t seen = 0;
      opened_.Await([&] {
        seen = state_;
        return (seen & kOpen) != 0 && seen / kLoop != last && static_cast<int>(own) < wanted_;
      });
      if (!state_.compare_exchange_strong(seen, seen + 1)) continue;
      last = seen / kLoop;
      Work(own);
      if ((--state_ & (kOpen | kInside)) == 0) emptied_.Notify();
    }
  }

  const pid_t process_ = getpid();
  std::atomic_flag taken_;
  std::atomic<int> wanted_{1};
  std::size_t started_ = 1;  // the caller is there
  std::atomic<std::uint64_t> state_{0};
  // Of the loop; read by those inside.
  std::vector<Share> shares_;
  const std::function<void(std::int64_t)>* body_ = nullptr;
  std::atomic<bool> failed_{false};
  std::mutex error_mutex_;
  std::exception_ptr error_;
  Signal opened_, emptied_;
};

}  // namespace

void SetPieceThreads(int threads) { Pool::Get().SetThreads(threads); }
int PieceThreads() { return Pool::Get().threads(); }

void ForPieces(std::int64_t count, const std::function<void(std::int64_t)>& body) {
  Pool& pool = Pool::Get();
  if (count <= 1 || pool.threads() == 1 || !pool.Take()) {
    for (std::int64_t i = 0; i < count; ++i) body(i);
    return;
  }
  struct Return {
    Pool* pool;
    ~Return() { pool->GiveBack(); }
  } const at_the_end{&pool};
  pool.Run(count, body);
}

}  // namespace antigrasp
