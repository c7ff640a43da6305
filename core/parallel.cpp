#include "antigrasp/core/parallel.h"

#include <omp.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>

#include "antigrasp/core/launch.h"

namespace antigrasp {

// Processes of one job share a machine's.
int HardwareThreads() { return std::max(1, omp_get_num_procs() / ProcessesHere()); }

void ParallelFor(std::int64_t count, int threads, const std::function<void(std::int64_t)>& body,
                 const ProgressFn& progress) {
  if (count <= 0) return;
  const int team =
      static_cast<int>(std::min<std::int64_t>(count, threads > 0 ? threads : HardwareThreads()));
  std::atomic<bool> stop{false};
  std::exception_ptr error;
  std::mutex mutex;  // guards error, done and the progress callback
  std::int64_t done = 0;
#pragma omp parallel for num_threads(team) schedule(dynamic, 1)
  for (std::int64_t i = 0; i < count; ++i) {
    if (stop.load(std::memory_order_relaxed)) continue;
    try {
      body(i);
      if (progress) {
        const std::lock_guard<std::mutex> lock(mutex);
        progress(++done, count);
      }
    } catch (...) {
      const std::lock_guard<std::mutex> lock(mutex);
      if (!error) error = std::current_exception();
      stop.store(true, std::memory_order_relaxed);
    }
  }
  if (error) std::rethrow_exception(error);
}

}  // namespace antigrasp
