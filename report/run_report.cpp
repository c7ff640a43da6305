#include "antigrasp/report/run_report.h"

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/format.h"
#include "antigrasp/report/gallery.h"
#include "antigrasp/report/run_stages.h"
#include "antigrasp/train/provenance.h"

namespace antigrasp {
namespace {

namespace fs = std::filesystem;

void AddIfKnown(const std::string& label, const std::string& text,
                std::vector<LabelledText>* lines) {
  if (!text.empty()) lines->emplace_back(label, text);
}

// "1 thread", "2 threads, 1 of LibTorch".
std::string ThreadsText(const Provenance& p) {
  const std::string text = std::to_string(p.threads) + (p.threads == 1 ? " thread" : " threads");
  return p.torch_threads == p.threads
             ? text
             : text + ", " + std::to_string(p.torch_threads) + " of LibTorch";
}

void AddProvenance(const RunFolder& run, Report* report) {
  const auto provenance = ReadProvenance(run);
  if (!provenance) {
    report->missing.push_back(
        "provenance.toml is not there: version, device and times of the run are not known.");
    return;
  }
  const Provenance& p = *provenance;
  auto* lines = &report->provenance;
  AddIfKnown("version", p.version, lines);
  AddIfKnown("commit", p.commit, lines);
  AddIfKnown("LibTorch", p.libtorch, lines);
  AddIfKnown("device", p.device, lines);
  AddIfKnown("threads", ThreadsText(p), lines);
  AddIfKnown("processor", p.cpu, lines);
  AddIfKnown("started", p.started, lines);
  AddIfKnown("finished", p.finished.empty() ? "not yet" : p.finished, lines);
  AddIfKnown("time", FormatDuration(p.seconds), lines);
}

}  // namespace

bool IsRun(const std::string& path) {
  const RunFolder run{path};
  return fs::is_directory(path) && (run.HoldsARun() || fs::exists(run.Statistics()));
}

Report RunReport(const RunFolder& run, const ReportSettings& settings, RunObserver* observer) {
  Report report;
  report.kind = "run";
  std::optional<RunConfig> config;
  if (run.HoldsARun()) {
    report.config = ReadFile(run.Config());
    config = NetworksFromToml(*report.config, run.Config().string());
    config->threads = settings.threads;
    report.metric = config->metric;
    report.provenance.emplace_back("seed", std::to_string(config->seed));
  } else {
    report.missing.push_back("config.toml is not there: no object can be shown.");
  }
  AddProvenance(run, &report);
  const RunTables tables = ReadRunTables(run, config ? &*config : nullptr, &report.missing);
  if (config) AddGallery(run, *config, tables, settings.per_stage, observer, &report);
  report.run = tables.run;
  return report;
}

}  // namespace antigrasp
