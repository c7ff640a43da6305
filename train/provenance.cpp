#include "antigrasp/train/provenance.h"

#include <torch/version.h>

#include <ctime>
#include <exception>
#include <fstream>
#include <utility>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/parallel.h"
#include "antigrasp/core/version.h"

namespace antigrasp {
namespace {

constexpr double kSaveEvery = 60.0;         // seconds
constexpr const char* kNeeded = "needed.";  // no key is: what another version wrote is left out

void Bind(OptionTable* table, Provenance* p) {
  table->Add("provenance.version", &p->version, {}, "of antigrasp");
  table->Add("provenance.commit", &p->commit, {}, "of antigrasp");
  table->Add("provenance.libtorch", &p->libtorch, {}, "version of LibTorch");
  table->Add("provenance.device", &p->device, {}, "of the networks");
  table->Add("provenance.cpu", &p->cpu, {}, "of the machine the run was started on");
  table->Add("provenance.threads", &p->threads, 0, 1e6, "of everything but training and sampling");
  table->Add("provenance.torch_threads", &p->torch_threads, 0, 1e6, "of training and sampling");
  table->Add("provenance.started", &p->started, {}, "time of day");
  table->Add("provenance.finished", &p->finished, {}, "time of day; empty: not yet");
  table->Add("provenance.seconds", &p->seconds, 0, 1e12, "of work, over all resumptions");
}

std::string UtcNow() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  char text[40];
  std::strftime(text, sizeof text, "%Y-%m-%d %H:%M:%S UTC", &utc);
  return text;
}

std::string CpuModel() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    const std::size_t colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "";
}

double SecondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

Provenance ProvenanceNow(const RunConfig& config) {
  Provenance now;
  now.version = ProgramVersion();
  now.commit = ProgramCommit();
  now.libtorch = TORCH_VERSION;
  now.device = config.device;
  now.cpu = CpuModel();
  now.threads = config.threads > 0 ? config.threads : HardwareThreads();
  now.torch_threads = config.torch_threads > 0 ? config.torch_threads : now.threads;
  now.started = UtcNow();
  return now;
}

std::optional<Provenance> ReadProvenance(const RunFolder& run) {
  if (!std::filesystem::exists(run.Provenance())) return std::nullopt;
  Provenance provenance;
  OptionTable table;
  Bind(&table, &provenance);
  table.ApplyKnown(ReadFile(run.Provenance()), run.Provenance().string(), kNeeded);
  return provenance;
}

ProvenanceRecorder::ProvenanceRecorder(RunFolder run, std::optional<Provenance> provenance,
                                       RunObserver* observer)
    : run_(std::move(run)), provenance_(std::move(provenance)), observer_(observer) {
  if (provenance_ && !provenance_->finished.empty()) provenance_.reset();
  if (provenance_) seconds_before_ = provenance_->seconds;
}

ProvenanceRecorder::~ProvenanceRecorder() {
  try {
    Save();
  } catch (const std::exception&) {  // the run's own files are what matters
  }
}

ProgressFn ProvenanceRecorder::Phase(const std::string& label) {
  Save();
  return [this, progress = observer_->Phase(label)](std::int64_t done, std::int64_t total) {
    if (SecondsSince(saved_) > kSaveEvery) Save();
    progress(done, total);
  };
}

void ProvenanceRecorder::Finish() {
  if (!provenance_) return;
  provenance_->finished = UtcNow();
  Save();
  provenance_.reset();
}

void ProvenanceRecorder::Save() {
  saved_ = Clock::now();
  if (!provenance_ || !run_.HoldsARun()) return;
  provenance_->seconds = seconds_before_ + SecondsSince(start_);
  OptionTable table;
  Bind(&table, &*provenance_);
  WriteFileAtomic(run_.Provenance(), table.Dump());
}

}  // namespace antigrasp
