#include <spdlog/spdlog.h>

#include <cstdio>
#include <memory>

#include "antigrasp/app/commands.h"
#include "antigrasp/app/console.h"
#include "antigrasp/app/flags.h"
#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/error.h"
#include "antigrasp/datasets/objects.h"
#include "antigrasp/export/print_table.h"
#include "antigrasp/mesh/mesh_file.h"

namespace antigrasp {
namespace {

struct ExportFlags {
  std::vector<std::string> inputs;
  std::string out;
  std::string format = "stl";
  std::string pose = "as-is";
  double size_mm = 60.0;
  int threads = 0;
};

// The usable objects that are printable solids, checked for printing; the others are warned about.
// InputError when there is none.
std::vector<PrintedObject> CheckSolids(std::vector<InputObject> objects, const ExportFlags& flags,
                                       const PrintOptions& options, const ProgressFn& progress) {
  std::vector<PrintedObject> checked(objects.size());
  ParallelFor(
      std::ssize(objects), flags.threads,
      [&](std::int64_t i) {
        PrintedObject& item = checked[static_cast<std::size_t>(i)];
        item.object = std::move(objects[static_cast<std::size_t>(i)]);
        if (!item.object.ok()) return;
        item.check = CheckPrint(item.object.mesh, flags.size_mm, options);
        if (!item.check.why_not_solid.empty()) item.object.status = item.check.why_not_solid;
      },
      progress);
  std::vector<std::string> refusals;
  for (const PrintedObject& item : checked) {
    if (!item.object.ok()) refusals.push_back(item.object.name + ": " + item.object.status);
  }
  if (refusals.size() == checked.size()) {
    throw InputError(refusals.front(), flags.inputs.front(), "a closed solid");
  }
  for (const std::string& refusal : refusals) spdlog::warn("not exported: {}", refusal);
  std::erase_if(checked, [](const PrintedObject& item) { return !item.object.ok(); });
  return checked;
}

void Export(const ExportFlags& flags, const PrintOptions& options) {
  ConsoleObserver console;
  std::vector<InputObject> objects =
      LoadObjects(flags.inputs, flags.threads, console.Phase("reading"));
  const std::size_t count = objects.size();
  const std::vector<PrintedObject> solids =
      CheckSolids(std::move(objects), flags, options, console.Phase("checking"));
  MakeFolder(flags.out);
  const std::filesystem::path out(flags.out);
  for (const PrintedObject& item : solids) {
    const Eigen::Matrix3d pose =
        flags.pose == "print" ? item.check.table_from_object : Eigen::Matrix3d::Identity();
    WriteMesh(out / (FileNameOf(item.object.name) + "." + flags.format),
              PlacedForPrint(item.object.mesh, item.check, pose));
  }
  WriteFileAtomic(out / "print.csv", PrintCsv(solids));
  std::printf("%zu of %zu objects in %s, largest extent %g mm\n%s", solids.size(), count,
              flags.out.c_str(), flags.size_mm, PrintSummary(solids, options).c_str());
}

}  // namespace

void AddExportCommand(CLI::App* app) {
  const auto flags = std::make_shared<ExportFlags>();
  CLI::App* command =
      app->add_subcommand("export", "Write printable solids in millimetres and check their print");
  command->add_option("OBJECT", flags->inputs, "meshes, folders of meshes, SDF files")->required();
  command->add_option("--out", flags->out, "folder of the meshes and print.csv")->required();
  command->add_option("--format", flags->format, "stl, obj, ply or off")
      ->check(CLI::IsMember({"stl", "obj", "ply", "off"}))
      ->capture_default_str();
  command->add_option("--size-mm", flags->size_mm, "largest extent in the object's own frame, mm")
      ->check(NumberIn(0.001, 1e5))
      ->capture_default_str();
  command
      ->add_option(
          "--pose", flags->pose,
          "as-is: the object's own axes, so that grasps and poses go with the file; print: "
          "turned into the pose suggested for printing")
      ->check(CLI::IsMember({"as-is", "print"}))
      ->capture_default_str();
  command->add_option("--threads", flags->threads, "threads; 0 = all")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  PrintOptions defaults;
  OptionTable table;
  Bind(&table, &defaults);
  const OptionFlags print_flags(command, table, "Print check");
  command->callback([flags, print_flags] {
    PrintOptions options;
    OptionTable own;
    Bind(&own, &options);
    print_flags.Apply(&own);
    Export(*flags, options);
  });
}

}  // namespace antigrasp
