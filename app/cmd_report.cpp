#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "antigrasp/app/commands.h"
#include "antigrasp/app/console.h"
#include "antigrasp/app/flags.h"
#include "antigrasp/app/network_commands.h"
#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/version.h"
#include "antigrasp/quality/sampling_effort.h"
#include "antigrasp/report/make_report.h"
#include "antigrasp/report/page/page.h"
#include "antigrasp/report/page/report_template.h"
#include "antigrasp/report/page/trial_folder.h"
#include "antigrasp/report/print_report.h"

namespace antigrasp {
namespace {

struct ReportFlags {
  ReportSettings settings;
  std::string out, title;
  std::vector<std::string> trials;
  double size_mm = 60.0;
};

std::string TitleOf(const std::vector<std::string>& inputs) {
  std::string title;
  for (const std::string& input : inputs) title += (title.empty() ? "" : ", ") + input;
  while (title.size() > 1 && title.ends_with('/')) title.pop_back();
  return title;
}

void WriteReport(const ReportFlags& flags, bool metric_given) {
  const AtomicFile probe(flags.out);  // refuses an unwritable target before the work
  for (const std::string& read : flags.settings.inputs) RequireApart({read, flags.out});
  for (const std::filesystem::path folder : flags.trials) {
    for (const char* name : {"trials.csv", "executions.csv", "replays.json"}) {
      RequireApart({folder / name, flags.out});
    }
  }
  const TrialsByObject trials = ReadTrials(flags.trials);
  ConsoleObserver console;
  Report report = MakeReport(flags.settings, metric_given, &console);
  if (!flags.trials.empty()) AddTrials(trials, &report);
  AddPrintChecks(flags.size_mm, flags.settings.threads, &console, &report);
  report.title = flags.title.empty() ? TitleOf(flags.settings.inputs) : flags.title;
  report.provenance.emplace_back("report made by",
                                 "antigrasp " + ProgramVersion() + " (" + ProgramCommit() + ")");
  PayloadOptions options;
  options.threads = flags.settings.threads;
  const ReportPayload payload = EncodeReport(report, options, console.Phase("packing"));
  const std::string page = FillTemplate(ReportTemplate(), report.title, payload);
  WriteFileAtomic(flags.out, page);
  for (const std::string& sentence : report.missing) {
    std::fprintf(stderr, "%s\n", sentence.c_str());
  }
  std::printf("%s: %zu objects, %.1f MB\n", flags.out.c_str(), report.objects.size(),
              1e-6 * static_cast<double>(page.size()));
}

}  // namespace

void AddReportCommand(CLI::App* app) {
  const auto flags = std::make_shared<ReportFlags>();
  ReportSettings& settings = flags->settings;
  CLI::App* command = app->add_subcommand(kReport.name, kReport.description);
  command
      ->add_option("INPUT", settings.inputs,
                   "a run; a folder that perturb wrote; or meshes, folders of meshes, SDF files "
                   "and scores of evaluate")
      ->required();
  command->add_option("--out", flags->out, "the page (HTML)")->required();
  command
      ->add_option("--trials", flags->trials,
                   "a folder of antigrasp trial: what simulated executions say of the objects, and "
                   "replays of them; once for every folder")
      ->allow_extra_args(false);
  command->add_option("--title", flags->title, "of the page; without it, the inputs");
  command
      ->add_option(
          "--per-stage", settings.per_stage,
          "objects shown of every stage of a run: half the least graspable, half at random")
      ->check(CLI::Range(0, 10000))
      ->capture_default_str();
  command->add_option("--limit", settings.limit, "objects shown of other inputs; 0 = all")
      ->capture_default_str();
  command->add_option("--size-mm", flags->size_mm, "largest extent in the print check, mm")
      ->check(NumberIn(0.001, 1e5))
      ->capture_default_str();
  CLI::Option* const seed =
      command->add_option("--seed", settings.seed, "random seed of the scores")
          ->capture_default_str();
  AddThreads(command, &settings.threads, "; no byte depends on it");
  const auto metric = std::make_shared<MetricFlags>(command);
  command->footer(EffortRule());
  command->callback([flags, metric, seed] {
    flags->settings.metric = metric->Resolve();
    flags->settings.raise_effort = !metric->effort_given();
    WriteReport(*flags, metric->given() || seed->count() > 0);
  });
}

}  // namespace antigrasp
