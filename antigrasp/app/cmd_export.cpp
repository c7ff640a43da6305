#include <spdlog/spdlog.h>

#include <cstdio>
#include <memory>

#include "antigrasp/app/commands.h"
#include "antigrasp/app/console.h"
#include "antigrasp/app/flags.h"
#include "antigrasp/app/input_objects.h"
#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/error.h"
#include "antigrasp/mesh/fit.h"
#include "antigrasp/mesh/inspect.h"
#include "antigrasp/mesh/mesh_file.h"

namespace antigrasp {
namespace {

struct ExportFlags {
  std::vector<std::string> inputs;
  std::string out;
  std::string format = "stl";
  double size_mm = 60.0;
  int threads = 0;
};

void Export(const ExportFlags& flags) {
  ConsoleObserver console;
  const std::vector<InputObject> objects =
      LoadObjects(flags.inputs, flags.threads, console.Phase("reading"));
  std::vector<const InputObject*> solids;
  std::vector<std::string> refusals;
  for (const InputObject& object : objects) {
    const std::string refusal = object.ok() ? WhyNotSolid(Inspect(object.mesh)) : object.status;
    if (refusal.empty()) {
      solids.push_back(&object);
    } else {
      refusals.push_back(object.name + ": " + refusal);
    }
  }
  if (solids.empty()) throw InputError(refusals.front(), flags.inputs.front(), "a closed solid");
  for (const std::string& refusal : refusals) spdlog::warn("not exported: {}", refusal);
  MakeFolder(flags.out);
  for (const InputObject* object : solids) {
    WriteMesh(std::filesystem::path(flags.out) / (FileNameOf(object->name) + "." + flags.format),
              FitToPlate(object->mesh, flags.size_mm));
  }
  std::printf("%zu of %zu objects in %s, largest extent %g mm\n", solids.size(), objects.size(),
              flags.out.c_str(), flags.size_mm);
}

}  // namespace

void AddExportCommand(CLI::App* app) {
  const auto flags = std::make_shared<ExportFlags>();
  CLI::App* command = app->add_subcommand("export", "Write printable solids in millimetres");
  command->add_option("OBJECT", flags->inputs, "meshes, folders of meshes, SDF files")->required();
  command->add_option("--out", flags->out, "folder")->required();
  command->add_option("--format", flags->format, "stl, obj, ply or off")
      ->check(CLI::IsMember({"stl", "obj", "ply", "off"}))
      ->capture_default_str();
  command->add_option("--size-mm", flags->size_mm, "largest extent, mm")
      ->check(NumberIn(0.001, 1e5))
      ->capture_default_str();
  command->add_option("--threads", flags->threads, "threads; 0 = all")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  command->callback([flags] { Export(*flags); });
}

}  // namespace antigrasp
