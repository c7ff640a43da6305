#include <cstdio>
#include <memory>

#include "antigrasp/app/commands.h"
#include "antigrasp/app/console.h"
#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/csv_writer.h"
#include "antigrasp/core/ordered_stream.h"
#include "antigrasp/core/staged_folder.h"
#include "antigrasp/datasets/objects.h"
#include "antigrasp/datasets/shape_set.h"
#include "antigrasp/mesh/mesh_file.h"
#include "antigrasp/mesh/mesh_format.h"

namespace antigrasp {
namespace {

struct RemeshFlags {
  std::string input;
  std::string out;
  std::string format = "obj";
  int threads = 0;
};

void RemeshFile(const RemeshFlags& flags) {
  ReadShapeSetInfo(flags.input);  // only SDF files have something to remesh
  const ObjectSource objects({flags.input});
  StagedFolder staged(flags.out);
  CsvWriter csv({"object", "status", "vertices", "faces", "volume", "area"});
  std::vector<std::string> statuses;
  ConsoleObserver console;
  StreamInOrder(
      objects.size(), flags.threads, [&](std::int64_t i) { return objects.Load(i); },
      [&](std::int64_t, const InputObject& object) {
        csv.Text(object.name).Text(object.status).Count(std::ssize(object.mesh.vertices));
        csv.Count(std::ssize(object.mesh.faces));
        csv.Numbers({Volume(object.mesh), SurfaceArea(object.mesh)}).EndRow();
        statuses.push_back(object.status);
        if (!object.ok()) return;
        WriteMesh(staged.path() / (FileNameOf(object.name) + "." + flags.format), object.mesh);
      },
      console.Phase("remeshing"));
  staged.Commit();
  WriteFileAtomic(std::filesystem::path(flags.out) / "remesh.csv", csv.text());
  std::printf("%s\nmeshes (unit cube) and remesh.csv in %s\n", CountByStatus(statuses).c_str(),
              flags.out.c_str());
}

}  // namespace

void AddRemeshCommand(CLI::App* app) {
  const auto flags = std::make_shared<RemeshFlags>();
  CLI::App* command =
      app->add_subcommand("remesh", "Turn SDF grids into meshes, with a watertightness check");
  command->add_option("SDF", flags->input, "SDF file (HDF5)")->required();
  command->add_option("--out", flags->out, "folder for the meshes and remesh.csv")->required();
  command->add_option("--format", flags->format, Alternatives(WritableExtensions()))
      ->check(CLI::IsMember(WritableExtensions()))
      ->capture_default_str();
  command->add_option("--threads", flags->threads, "threads; 0 = all")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  command->callback([flags] { RemeshFile(*flags); });
}

}  // namespace antigrasp
