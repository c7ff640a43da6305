#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "antigrasp/core/observer.h"
#include "antigrasp/train/run_config.h"
#include "antigrasp/train/run_folder.h"

namespace antigrasp {

// With what and when a run was made: RUN/provenance.toml. It holds the time of day, so that equal
// runs differ in it; no result depends on it.
struct Provenance {
  std::string version, commit;  // of this program
  std::string libtorch;         // "1.13.0"
  std::string device;           // cpu, cuda, cuda:1
  std::string cpu;              // "AMD EPYC 7B13", or "" when the system does not say
  int threads = 0;              // of everything but training and sampling
  int torch_threads = 0;
  std::string started;   // "2026-11-25 22:10:03 UTC"
  std::string finished;  // the same; "" until the run is
  double seconds = 0.0;  // of work, over all resumptions
};

// Of a run that starts here and now.
Provenance ProvenanceNow(const RunConfig& config);

// nullopt when the run has none (it was begun by an older version). InputError when the file is
// damaged.
std::optional<Provenance> ReadProvenance(const RunFolder& run);

// Keeps a run's provenance while it works: passes everything on to `observer` and brings the file
// up to date at every phase, once a minute within one, and when it goes. Writes nothing as long as
// the folder holds no run, for a run without provenance and for one that had finished.
class ProvenanceRecorder : public RunObserver {
 public:
  ProvenanceRecorder(RunFolder run, std::optional<Provenance> provenance, RunObserver* observer);
  ~ProvenanceRecorder() override;

  ProgressFn Phase(const std::string& label) override;
  void Detail(const std::string& text) override { observer_->Detail(text); }
  void Note(const std::string& text) override { observer_->Note(text); }
  bool StopRequested() const override { return observer_->StopRequested(); }

  void Finish();

 private:
  using Clock = std::chrono::steady_clock;
  void Save();

  RunFolder run_;
  std::optional<Provenance> provenance_;
  RunObserver* observer_;
  double seconds_before_ = 0.0;
  Clock::time_point start_ = Clock::now(), saved_ = start_;
};

}  // namespace antigrasp
