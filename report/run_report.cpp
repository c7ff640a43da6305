#include "antigrasp/report/run_report.h"

#include <filesystem>

#include "antigrasp/core/format.h"
#include "antigrasp/report/gallery.h"
#include "antigrasp/report/run_stages.h"
#include "antigrasp/train/run_record.h"

namespace antigrasp {
namespace {

void AddIfKnown(const std::string& label, const std::string& text,
                std::vector<LabelledText>* lines) {
  if (!text.empty()) lines->emplace_back(label, text);
}

// "1 thread", "2 threads, 1 of training".
std::string ThreadsText(const Provenance& p) {
  const std::string text = std::to_string(p.threads) + (p.threads == 1 ? " thread" : " threads");
  return p.torch_threads == p.threads
             ? text
             : text + ", " + std::to_string(p.torch_threads) + " of training";
}

void AddProvenance(const std::optional<Provenance>& provenance, Report* report) {
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
  return std::filesystem::is_directory(path) && RunFolder{path}.HoldsTables();
}

Report RunReport(const RunFolder& folder, const ReportSettings& settings, RunObserver* observer,
                 const ShapeModelMaker& make) {
  const RunRecord run = ReadRun(folder.root);
  Report report;
  report.kind = "run";
  if (run.config) {
    report.config = run.config_toml;
    report.metric = run.config->metric;
    report.provenance.emplace_back("seed", std::to_string(run.config->seed));
  } else {
    report.missing.push_back("config.toml is not there: no object can be shown.");
  }
  AddProvenance(run.provenance, &report);
  report.run = StagesOf(run, &report.missing);
  if (run.config) {
    RunConfig config = *run.config;
    config.threads = settings.threads;
    AddGallery(run, config, settings.per_stage, make, observer, &report);
  }
  return report;
}

}  // namespace antigrasp
