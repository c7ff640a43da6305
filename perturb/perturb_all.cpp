#include "antigrasp/perturb/perturb_all.h"

#include <cstdint>
#include <mutex>
#include <utility>

#include "antigrasp/core/error.h"
#include "antigrasp/core/parallel.h"
#include "antigrasp/core/shared_stream.h"
#include "antigrasp/perturb/pass_perturbed.h"

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
                                        const ProgressFn& progress, WorkShare* share) {
  std::vector<PerturbedObject> objects(inputs.size());
  for (std::size_t i = 0; i < inputs.size(); ++i) objects[i].object = std::move(inputs[i]);
  SharedProgress shared(objects.size(), progress);
  std::vector<std::int64_t> at(objects.size(), 0);
  const auto perturb = [&](std::int64_t i) {
    const InputObject& object = objects[static_cast<std::size_t>(i)].object;
    if (!object.ok()) return ScoredPerturbation{};
    return PerturbAndScore(
        object.mesh, settings, object.stream, [&](std::int64_t done, std::int64_t total) {
          if (stop()) throw Interrupted();
          if (Helps(share)) return;
          // The scores before and after take the rest.
          shared.Report(0.99 * double(done) / double(total), &at[static_cast<std::size_t>(i)]);
        });
  };
  std::vector<char> done(objects.size(), 0);
  const auto take = [&](std::int64_t i, ScoredPerturbation scored) {
    const auto slot = static_cast<std::size_t>(i);
    objects[slot].scored = std::move(scored);
    done[slot] = 1;
    shared.Report(1.0, &at[slot]);
  };
  try {
    if (share != nullptr) {
      const ProgressFn pause = [&](std::int64_t, std::int64_t) {
        if (stop()) throw Interrupted();
      };
      StreamShared(share, std::ssize(objects), threads, perturb, take, pause);
    } else {
      ParallelFor(std::ssize(objects), threads, [&](std::int64_t i) {
        try {
          take(i, perturb(i));
        } catch (const Interrupted&) {  // others may be done all the same
        }
      });
    }
  } catch (const Interrupted&) {
    if (Helps(share)) throw;
  }
  for (std::size_t i = 0; i < objects.size(); ++i) {
    objects[i].interrupted = done[i] == 0;
  }
  return objects;
}

}  // namespace antigrasp
