#include <cstdio>
#include <memory>

#include "antigrasp/app/commands.h"
#include "antigrasp/app/console.h"
#include "antigrasp/app/flags.h"
#include "antigrasp/core/error.h"
#include "antigrasp/datasets/remesh_folder.h"
#include "antigrasp/datasets/shape_format.h"
#include "antigrasp/mesh/mesh_format.h"

namespace antigrasp {
namespace {

void Remesh(const RemeshRequest& request) {
  ConsoleObserver console;
  const RemeshedFolder done = RemeshIntoFolder(request, console.Phase("remeshing"));
  std::printf("%s\n", done.counts.c_str());
  if (!done.any) {
    throw RuntimeFailure("no grid gave a mesh: " + done.table.string() + " says why");
  }
  std::printf("meshes (unit cube) and remesh.csv in %s\n", request.out.c_str());
}

}  // namespace

void AddRemeshCommand(CLI::App* app) {
  const auto flags = std::make_shared<RemeshRequest>();
  CLI::App* command =
      app->add_subcommand("remesh", "Turn SDF grids into meshes, with a watertightness check");
  command->add_option("SDF", flags->input, ShapeFileKinds())->required();
  command->add_option("--out", flags->out, "folder for the meshes and remesh.csv")->required();
  AddOverwrite(command, &flags->overwrite);
  command->add_option("--format", flags->format, Alternatives(WritableExtensions()))
      ->check(CLI::IsMember(WritableExtensions()))
      ->capture_default_str();
  command->add_option("--grids", flags->grids,
                      "exact distances to the meshes: " + ShapeFileKinds());
  AddThreads(command, &flags->threads);
  command->callback([flags] { Remesh(*flags); });
}

}  // namespace antigrasp
