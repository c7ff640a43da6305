#pragma once

#include <string>

#include "antigrasp/core/error.h"
#include "antigrasp/core/observer.h"
#include "antigrasp/train/run_config.h"

namespace antigrasp::shapes {

// Small enough for a second; what is learnt does not matter here.
inline RunConfig Tiny() {
  RunConfig config;
  config.threads = 2;
  config.torch_threads = 1;  // tests run side by side
  config.prior.count = 8;
  config.model.width = 4;
  config.model.latent = 8;
  config.gan.batch = 4;
  config.gan.learning_rate_g = config.gan.learning_rate_d = 4e-3;
  config.cem.episodes = 2;
  config.cem.prior_iterations = 20;
  config.cem.iterations = 4;
  config.cem.samples = 8;
  config.cem.keep = 3;
  config.cem.prior_fraction = 0.5;
  config.cem.prior_scored = 4;
  config.cem.checkpoint_every = 4;
  config.metric.num_grasps = 10;
  config.metric.num_draws = 4;
  config.metric.max_attempts = 200;
  config.stl_count = 2;
  return config;
}

// Stops after a number of progress reports, as a signal at that moment would.
class StoppingObserver : public RunObserver {
 public:
  explicit StoppingObserver(int reports = -1) : left_(reports) {}
  ProgressFn Phase(const std::string& label) override {
    phase_ = label;
    return [this](std::int64_t, std::int64_t) {
      if (left_ >= 0 && left_-- == 0) {
        left_ = 0;
        throw Interrupted();
      }
    };
  }
  void Detail(const std::string&) override {}
  bool StopRequested() const override { return left_ == 0; }
  const std::string& phase() const { return phase_; }  // the last one that began

 private:
  int left_;
  std::string phase_;
};

}  // namespace antigrasp::shapes
