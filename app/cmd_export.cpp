#include <spdlog/spdlog.h>

#include <array>
#include <cstdio>
#include <memory>
#include <numeric>

#include "antigrasp/app/commands.h"
#include "antigrasp/app/console.h"
#include "antigrasp/app/flags.h"
#include "antigrasp/app/hardest.h"
#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/error.h"
#include "antigrasp/core/ordered_stream.h"
#include "antigrasp/datasets/objects.h"
#include "antigrasp/datasets/result_folder.h"
#include "antigrasp/export/print_table.h"
#include "antigrasp/mesh/mesh_file.h"
#include "antigrasp/mesh/mesh_format.h"
#include "antigrasp/quality/object_size.h"

namespace antigrasp {
namespace {

enum class ExportPose { kAsIs, kPrint };
constexpr auto ChoicesOf(ExportPose) {
  return std::to_array<Choice<ExportPose>>(
      {{ExportPose::kAsIs, "as-is"}, {ExportPose::kPrint, "print"}});
}

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

// A usable object that is a printable solid, placed as it will be written; else why it is none.
struct Placed {
  PrintedObject printed;
  std::string note, refusal;
  TriangleMesh mesh;
};

Placed PlaceForPrint(InputObject object, const ExportFlags& flags, const PrintOptions& options) {
  Placed placed{
      {object.name, FileNameOf(object.name) + "." + flags.format, {}}, object.note, "", {}};
  if (!object.ok()) {
    placed.refusal = object.status;
    return placed;
  }
  PrintCheck& check = placed.printed.check;
  check = CheckPrint(object.mesh, flags.SizeOf(object.mesh), options);
  placed.refusal = check.why_not_solid;
  if (!placed.refusal.empty()) return placed;
  const Eigen::Matrix3d pose =
      flags.pose == ExportPose::kPrint ? check.table_from_object : Eigen::Matrix3d::Identity();
  placed.mesh = PlacedForPrint(object.mesh, check, pose);
  return placed;
}

// The hardest objects, and their scores into the folder.
std::vector<std::int64_t> ChooseHardest(const ObjectSource& objects, const ExportFlags& flags,
                                        const MetricOptions& metric,
                                        const std::filesystem::path& folder) {
  ConsoleObserver console;
  const std::vector<ScoreRow> rows =
      ScoreRowsOf(objects, metric, flags.seed, flags.threads, &console);
  const std::vector<HardestObject> hardest =
      FindHardest(objects, rows, flags.hardest, metric, flags.seed, flags.threads, &console);
  for (const ScoreRow& row : rows) {
    if (!row.score) spdlog::warn("not scored: {}: {}", row.object, row.status);
  }
  if (hardest.empty()) throw InputError("no object scored", flags.inputs.front(), "a closed solid");
  std::vector<std::int64_t> places;
  ScoreTable table;
  for (const HardestObject& found : hardest) {
    places.push_back(found.place);
    table.Add(found.row);
  }
  WriteFileAtomic(folder / kScores, table.Csv());
  WriteFileAtomic(folder / kConstants, MetricToml(metric, flags.seed));
  std::fprintf(stderr, "%s\n", HardestText(hardest, objects.size()).c_str());
  return places;
}

void Export(const ExportFlags& flags, const PrintOptions& options,
            const MetricFlags& metric_flags) {
  MetricOptions metric = metric_flags.Resolve();
  if (flags.true_size) {
    metric.object_min_extent = 0.0;
    metric.units = flags.units;
  }
  const ObjectSource objects(flags.inputs);
  metric_flags.RaiseEffort(objects.size(), &metric);
  const std::filesystem::path out = flags.out;
  RequireNotRead(metric_flags.gripper(), {out / kScores, out / kConstants});
  ResultFolder results(flags.out, {"print.csv", {kScores, kConstants}, {"NAME." + flags.format}},
                       objects, flags.overwrite);
  std::vector<std::int64_t> places(static_cast<std::size_t>(objects.size()));
  std::iota(places.begin(), places.end(), 0);
  if (flags.hardest > 0) places = ChooseHardest(objects, flags, metric, results.path());
  PrintTable solids(options);
  std::vector<std::string> refusals;
  MetricOptions as_it_is;
  as_it_is.object_min_extent = 0.0;
  as_it_is.units = flags.units;
  UnlikelySizes sizes(as_it_is);
  ConsoleObserver console;
  StreamInOrder(
      std::ssize(places), flags.threads,
      [&](std::int64_t i) {
        return PlaceForPrint(objects.Load(places[static_cast<std::size_t>(i)]), flags, options);
      },
      [&](std::int64_t, Placed item) {
        if (!item.note.empty()) spdlog::warn("{}: {}", item.printed.name, item.note);
        if (!item.refusal.empty()) {
          refusals.push_back(item.printed.name + ": " + item.refusal);
          return;
        }
        WriteMesh(results.path() / item.printed.file, item.mesh);
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
  command->add_option("--format", flags->format, Alternatives(WritableExtensions()))
      ->check(CLI::IsMember(WritableExtensions()))
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
  AddUnits(command, &flags->units, " (of an SDF file: the side of its cube), with --true-size");
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
  command->add_option("--threads", flags->threads, "threads; 0 = all")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  PrintOptions defaults;
  OptionTable table;
  Bind(&table, &defaults);
  const OptionFlags print_flags(command, table, "Print check");
  command->callback([flags, print_flags, metric_flags] {
    if (flags->hardest == 0 && metric_flags->given()) {
      throw InputError("constants of the metric", "command line", "--hardest N beside them");
    }
    PrintOptions options;
    OptionTable own;
    Bind(&own, &options);
    print_flags.Apply(&own);
    Export(*flags, options, *metric_flags);
  });
}

}  // namespace antigrasp
