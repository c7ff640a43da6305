#include <spdlog/spdlog.h>

#include <cstdio>
#include <memory>
#include <numeric>
#include <utility>

#include "antigrasp/app/commands.h"
#include "antigrasp/app/console.h"
#include "antigrasp/app/flags.h"
#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/error.h"
#include "antigrasp/core/ordered_stream.h"
#include "antigrasp/datasets/objects.h"
#include "antigrasp/datasets/result_folder.h"
#include "antigrasp/export/print_files.h"
#include "antigrasp/export/print_place.h"
#include "antigrasp/judge/score_objects.h"
#include "antigrasp/quality/object_size.h"
#include "antigrasp/quality/sampling_effort.h"

namespace antigrasp {
namespace {

// Of --hardest.
constexpr const char* kScores = "hardest.csv";
constexpr const char* kConstants = "hardest.csv.metric.toml";

struct ExportFlags {
  std::vector<std::string> inputs;
  std::string out;
  std::string format = "stl";
  ExportPose pose = ExportPose::kAsIs;
  double size_mm = 60.0;
  bool true_size = false;
  LengthUnit units = LengthUnit::kM;
  bool overwrite = false;
  int hardest = 0;  // 0: all objects
  std::uint64_t seed = 1;
  int threads = 0;

  double SizeOf(const TriangleMesh& mesh) const {
    return true_size ? 1000.0 * MetresPer(units) * Bounds(mesh).Extent().maxCoeff() : size_mm;
  }
};

PlacedSolid Place(const InputObject& object, const ExportFlags& flags,
                  const PrintOptions& options) {
  if (!object.ok()) return {{object.name, "", {}}, object.status, {}};
  return PlaceForPrint(object.name, PrintFiles::FileOf(FileNameOf(object.name), flags.format),
                       object.mesh, flags.SizeOf(object.mesh), flags.pose, options);
}

// The hardest objects, and their scores into the folder.
std::vector<std::int64_t> ChooseHardest(const ObjectSource& objects, const ExportFlags& flags,
                                        const Scoring& scoring,
                                        const std::filesystem::path& folder) {
  const HardestOfSet hardest = FindHardest(objects, flags.inputs.front(), flags.hardest, scoring);
  WriteFileAtomic(folder / kScores, HardestCsv(hardest));
  WriteFileAtomic(folder / kConstants, MetricToml(scoring.metric, flags.seed));
  for (const std::string& line : hardest.summary) std::fprintf(stderr, "%s\n", line.c_str());
  std::vector<std::int64_t> places;
  for (const HardestObject& found : hardest.objects) places.push_back(found.place);
  return places;
}

void Export(const ExportFlags& flags, const PrintOptions& options,
            const MetricFlags& metric_flags) {
  ConsoleObserver console;
  Scoring scoring{metric_flags.Resolve(), metric_flags.effort_given(),
                  metric_flags.preset() == "egad", flags.seed, flags.threads};
  scoring.observer = &console;
  scoring.warn = &Warn;
  if (flags.true_size) {
    scoring.metric.object_min_extent = 0.0;
    scoring.metric.units = flags.units;
  }
  const ObjectSource objects(flags.inputs, GridUnit::kOfFiles, UnitToReadIn(scoring.metric));
  metric_flags.RaiseEffort(objects.size(), &scoring.metric);
  const std::filesystem::path out = flags.out;
  RequireNotRead(metric_flags.gripper(), {out / kScores, out / kConstants});
  ResultFolder results(
      flags.out, {"print.csv", {kScores, kConstants, PrintFiles::kPlate}, {"NAME." + flags.format}},
      objects, flags.overwrite);
  PrintFiles files(results.path(), flags.format);
  std::vector<std::int64_t> places(static_cast<std::size_t>(objects.size()));
  std::iota(places.begin(), places.end(), 0);
  if (flags.hardest > 0) places = ChooseHardest(objects, flags, scoring, results.path());
  PrintTable solids(options);
  std::vector<std::string> refusals;
  MetricOptions as_it_is;
  as_it_is.object_min_extent = 0.0;
  as_it_is.units = flags.units;
  UnlikelySizes sizes(as_it_is);
  StreamInOrder(
      std::ssize(places), flags.threads,
      [&](std::int64_t i) {
        const InputObject object = objects.Load(places[static_cast<std::size_t>(i)]);
        return std::pair(Place(object, flags, options), object.note);
      },
      [&](std::int64_t, std::pair<PlacedSolid, std::string> placed) {
        auto& [item, note] = placed;
        if (!note.empty()) spdlog::warn("{}: {}", item.printed.name, note);
        if (!item.refusal.empty()) {
          refusals.push_back(item.printed.name + ": " + item.refusal);
          return;
        }
        files.Add(item.printed.name, item.printed.file, item.mesh);
        const PrintCheck& check = item.printed.check;
        if (flags.true_size) sizes.Add(item.printed.name, check.size_mm / check.mm_per_unit);
        solids.Add(std::move(item.printed));
        results.AddToTable(solids.TakeText());
      },
      console.Phase("checking"));
  if (solids.size() == 0)
    throw InputError(refusals.front(), flags.inputs.front(), "a closed solid");
  for (const std::string& refusal : refusals) spdlog::warn("not exported: {}", refusal);
  for (const std::string& size : sizes.Texts()) spdlog::warn("{}", size);
  files.Close();
  results.Commit(solids.TakeText());
  std::printf("%zu of %zu objects in %s, ", solids.size(), solids.size() + refusals.size(),
              flags.out.c_str());
  if (flags.true_size) {
    std::printf("at true size (%s)\n", ChoiceName(flags.units).c_str());
  } else {
    std::printf("largest extent %g mm\n", flags.size_mm);
  }
  std::fputs(solids.Summary().c_str(), stdout);
}

}  // namespace

void AddExportCommand(CLI::App* app) {
  const auto flags = std::make_shared<ExportFlags>();
  CLI::App* command =
      app->add_subcommand("export", "Write printable solids in millimetres and check their print");
  command->add_option("OBJECT", flags->inputs, "meshes, folders of meshes, SDF files")->required();
  command->add_option("--out", flags->out, "folder of the meshes and print.csv")->required();
  AddOverwrite(command, &flags->overwrite);
  command
      ->add_option("--format", flags->format,
                   Alternatives(ExportFormats()) + "; 3mf: all of them on one plate, plate.3mf")
      ->check(CLI::IsMember(ExportFormats()))
      ->capture_default_str();
  command->add_option("--size-mm", flags->size_mm, "largest extent in the object's own frame, mm")
      ->check(NumberIn(0.001, 1e5))
      ->capture_default_str();
  const auto metric_flags = std::make_shared<MetricFlags>(command);
  for (const char* name : {"--true-size", "--units"}) {  // both say how it is printed, too
    command->remove_option(command->get_option(name));
  }
  CLI::Option* const true_size =
      command->add_flag("--true-size", flags->true_size, "as large as it is, not --size-mm");
  true_size->excludes("--size-mm");
  AddUnits(command, &flags->units,
           " (of an SDF file: of the meshes imported with one factor, else the side of its cube), "
           "with --true-size");
  command->get_option("--units")->needs(true_size);
  AddChoice(command, "--pose", &flags->pose,
            "as-is: the object's own axes, so that grasps and poses go with the file; print: "
            "turned into the pose suggested for printing");
  CLI::Option* const hardest = AddHardestFlag(
      command, &flags->hardest,
      "only the N objects with the lowest graspability, scored again with fresh draws: both scores "
      "go to hardest.csv in the folder");
  command->add_option("--seed", flags->seed, "random seed of the scores")
      ->capture_default_str()
      ->needs(hardest);
  AddThreads(command, &flags->threads);
  command->footer(EffortRule());
  const OptionFlags print_flags = AddOptions<PrintOptions>(command, "Print check");
  command->callback([flags, print_flags, metric_flags] {
    if (flags->hardest == 0 && metric_flags->given()) {
      throw InputError("constants of the metric", "command line", "--hardest N beside them");
    }
    Export(*flags, GivenOptions<PrintOptions>(print_flags), *metric_flags);
  });
}

}  // namespace antigrasp
