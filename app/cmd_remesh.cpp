#include <algorithm>
#include <cstdio>
#include <memory>

#include "antigrasp/app/commands.h"
#include "antigrasp/app/console.h"
#include "antigrasp/app/flags.h"
#include "antigrasp/core/csv_writer.h"
#include "antigrasp/core/error.h"
#include "antigrasp/core/ordered_stream.h"
#include "antigrasp/datasets/objects.h"
#include "antigrasp/datasets/result_folder.h"
#include "antigrasp/datasets/shape_set.h"
#include "antigrasp/mesh/mesh_file.h"
#include "antigrasp/mesh/mesh_format.h"

namespace antigrasp {
namespace {

struct RemeshFlags {
  std::string input;
  std::string out;
  std::string format = "obj";
  bool overwrite = false;
  int threads = 0;
};

void RemeshFile(const RemeshFlags& flags) {
  ReadShapeSetInfo(flags.input);  // only SDF files have something to remesh
  const ObjectSource objects({flags.input}, GridUnit::kCube);
  ResultFolder results(flags.out, {"remesh.csv", {}, {"NAME." + flags.format}}, objects,
                       flags.overwrite);
  CsvWriter csv({"object", "status", "vertices", "faces", "volume", "area", "file"});
  std::vector<std::string> statuses;
  ConsoleObserver console;
  StreamInOrder(
      objects.size(), flags.threads, [&](std::int64_t i) { return objects.Load(i); },
      [&](std::int64_t, const InputObject& object) {
        csv.Text(object.name).Text(object.status).Count(std::ssize(object.mesh.vertices));
        csv.Count(std::ssize(object.mesh.faces));
        csv.Numbers({Volume(object.mesh), SurfaceArea(object.mesh)});
        const std::string file = FileNameOf(object.name) + "." + flags.format;
        csv.Text(object.ok() ? file : "").EndRow();
        results.AddToTable(csv.TakeText());
        statuses.push_back(object.status);
        if (object.ok()) WriteMesh(results.path() / file, object.mesh);
      },
      console.Phase("remeshing"));
  results.Commit(csv.TakeText());
  std::printf("%s\n", CountByStatus(statuses).c_str());
  if (std::find(statuses.begin(), statuses.end(), "ok") == statuses.end()) {
    throw RuntimeFailure("no grid gave a mesh: " + results.table().string() + " says why");
  }
  std::printf("meshes (unit cube) and remesh.csv in %s\n", flags.out.c_str());
}

}  // namespace

void AddRemeshCommand(CLI::App* app) {
  const auto flags = std::make_shared<RemeshFlags>();
  CLI::App* command =
      app->add_subcommand("remesh", "Turn SDF grids into meshes, with a watertightness check");
  command->add_option("SDF", flags->input, "SDF file (HDF5)")->required();
  command->add_option("--out", flags->out, "folder for the meshes and remesh.csv")->required();
  AddOverwrite(command, &flags->overwrite);
  command->add_option("--format", flags->format, Alternatives(WritableExtensions()))
      ->check(CLI::IsMember(WritableExtensions()))
      ->capture_default_str();
  AddThreads(command, &flags->threads);
  command->callback([flags] { RemeshFile(*flags); });
}

}  // namespace antigrasp
