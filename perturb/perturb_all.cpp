#include "antigrasp/perturb/perturb_all.h"

#include <cstdint>
#include <mutex>
#include <utility>

#include "antigrasp/core/error.h"
#include "antigrasp/core/parallel.h"

namespace antigrasp {
namespace {

// Turns the progress of objects that run at the same time into that of the whole.
class SharedProgress {
 public:
  SharedProgress(std::size_t objects, ProgressFn progress)
      : total_(kSteps * static_cast<std::int64_t>(objects)), progress_(std::move(progress)) {}

  // To be called with growing shares of one object; `at` remembers the last.
  void Report(double share, std::int64_t* at) {
    const auto now = static_cast<std::int64_t>(share * kSteps);
    if (now <= *at) return;
    const std::lock_guard<std::mutex> lock(mutex_);
    done_ += now - *at;
    *at = now;
    progress_(done_, total_);
  }

 private:
  static constexpr std::int64_t kSteps = 100;
  std::mutex mutex_;
  std::int64_t done_ = 0, total_;
  ProgressFn progress_;
};

}  // namespace

std::vector<PerturbedObject> PerturbAll(std::vector<InputObject> inputs,
                                        const PerturbSettings& settings, int threads,
                                        const std::function<bool()>& stop,
                                        const ProgressFn& progress) {
  std::vector<PerturbedObject> objects(inputs.size());
  SharedProgress shared(inputs.size(), progress);
  ParallelFor(std::ssize(inputs), threads, [&](std::int64_t i) {
    PerturbedObject& item = objects[static_cast<std::size_t>(i)];
    item.object = std::move(inputs[static_cast<std::size_t>(i)]);
    std::int64_t at = 0;
    try {
      if (item.object.ok()) {
        item.scored = PerturbAndScore(item.object.mesh, settings, item.object.stream,
                                      [&](std::int64_t done, std::int64_t total) {
                                        if (stop()) throw Interrupted();
                                        // The scores before and after take the rest.
                                        shared.Report(0.99 * double(done) / double(total), &at);
                                      });
      }
      shared.Report(1.0, &at);
    } catch (const Interrupted&) {
      item.interrupted = item.scored.result.mesh.faces.empty();
    }
  });
  return objects;
}

}  // namespace antigrasp
