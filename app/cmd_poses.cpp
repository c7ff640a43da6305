#include <spdlog/spdlog.h>

#include <cstdio>
#include <memory>

#include "antigrasp/app/commands.h"
#include "antigrasp/app/console.h"
#include "antigrasp/app/flags.h"
#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/error.h"
#include "antigrasp/datasets/objects.h"
#include "antigrasp/judge/object_notes.h"
#include "antigrasp/mesh/pose_table.h"

namespace antigrasp {
namespace {

struct PosesFlags {
  std::vector<std::string> inputs;
  std::string out;
  LengthUnit units = LengthUnit::kM;
  int threads = 0;
};

void Poses(const PosesFlags& flags) {
  if (!flags.out.empty()) const AtomicFile probe(flags.out);  // refused before the work
  ConsoleObserver console;
  const ObjectSource source(flags.inputs, GridUnit::kOfFiles, flags.units);
  source.RequireNotRead({flags.out});
  const std::vector<InputObject> objects =
      LoadObjects(source, flags.threads, console.Phase("reading"));
  WarnOfNotes(objects, &Warn);
  std::vector<std::vector<StablePose>> poses(objects.size());
  ParallelFor(
      std::ssize(objects), flags.threads,
      [&](std::int64_t i) {
        const auto slot = static_cast<std::size_t>(i);
        poses[slot] = StablePosesOf(objects[slot].mesh, objects[slot].ok());
      },
      console.Phase("stable poses"));
  PoseTable table(flags.units);
  std::size_t with_poses = 0;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    with_poses += poses[i].empty() ? 0 : 1;
    table.Add(objects[i].name, poses[i]);
  }
  if (with_poses == 0) {
    throw InputError("no stable pose", flags.inputs.front(), "an object that is not flat");
  }
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const InputObject& object = objects[i];
    if (poses[i].empty()) {
      spdlog::warn("{}: no stable pose: {}", object.name, object.ok() ? "flat" : object.status);
    } else if (!object.ok()) {
      spdlog::warn("{}: {}; with the centre of mass of its convex hull", object.name,
                   object.status);
    }
  }
  if (flags.out.empty()) {
    std::printf("%s", table.Csv().c_str());
  } else {
    WriteFileAtomic(flags.out, table.Csv());
  }
  for (std::size_t i = 0; i < objects.size(); ++i) {
    if (poses[i].empty()) continue;
    std::fprintf(stderr, "%s: %zu stable poses, the likeliest %.1f %%\n", objects[i].name.c_str(),
                 poses[i].size(), 100.0 * poses[i].front().probability);
  }
}

constexpr const char* kPoseColumns =
    "Columns: probability of the pose after a drop in a random orientation (quasi-static);\n"
    "com_height, the centre of mass above the table in metres, the mesh's unit being --units;\n"
    "r00 ... r22, the rotation from the object to the table frame by rows: r20 r21 r22 is the\n"
    "table's normal, up, in the object frame.\n";

}  // namespace

void AddPosesCommand(CLI::App* app) {
  const auto flags = std::make_shared<PosesFlags>();
  CLI::App* command =
      app->add_subcommand("poses", "Compute the stable poses of objects and their probabilities");
  command->add_option("OBJECT", flags->inputs, "meshes, folders of meshes, SDF files")->required();
  command->add_option("--out", flags->out, "poses (CSV). Without it they go to standard output");
  AddUnits(command, &flags->units, ", for com_height");
  AddThreads(command, &flags->threads);
  command->footer(kPoseColumns);
  command->callback([flags] { Poses(*flags); });
}

}  // namespace antigrasp
