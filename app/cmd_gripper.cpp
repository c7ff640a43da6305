#include <cstdio>
#include <filesystem>
#include <memory>

#include "antigrasp/app/commands.h"
#include "antigrasp/app/flags.h"
#include "antigrasp/core/atomic_file.h"
#include "antigrasp/mesh/mesh_file.h"
#include "antigrasp/mesh/mesh_format.h"
#include "antigrasp/quality/named_gripper.h"
#include "antigrasp/render/render_mesh.h"

namespace antigrasp {
namespace {

constexpr double kMillimetres = 1000.0;

// As it stands above a table: the approach points down.
TriangleMesh PointingDown(TriangleMesh mesh) {
  for (Eigen::Vector3d& v : mesh.vertices) v = {v.y(), -v.z(), -v.x()};
  return mesh;
}

void Gripper(const std::string& name, const std::string& out) {
  MetricOptions metric;
  ApplyGripper(name, &metric);
  RequireFittingGripper(metric, name);
  const std::string toml = GripperToml(metric, BaseOf(name), AboutGripper(name) + ". Metres");
  const std::filesystem::path path = out;
  RequireNotRead(name, {path});
  const bool as_mesh = !out.empty() && path.extension() != ".png" && path.extension() != ".toml";
  if (as_mesh) RequireWritableFormat(path);
  std::fputs(toml.c_str(), stdout);
  const TriangleMesh mesh = GripperMesh(metric.gripper, metric.jaw_opening);
  if (path.extension() == ".png") {
    View view;
    view.pixels = 512;
    WritePng(path, RenderMesh(PointingDown(mesh), view));
  } else if (path.extension() == ".toml") {
    WriteFileAtomic(path, toml);
  } else if (as_mesh) {
    WriteMesh(path, mesh, kMillimetres);
  }
}

constexpr const char* kAbout =
    "Without a name: the grippers that are known. What is printed of one is a file that --gripper\n"
    "takes, a start for one's own. The mesh is in the gripper's frame: origin at the grasp's "
    "centre,\n"
    "x out of the palm, y from jaw to jaw. docs/grippers.md says where the numbers come from.\n";

}  // namespace

void AddGripperCommand(CLI::App* app) {
  const auto name = std::make_shared<std::string>(), out = std::make_shared<std::string>();
  CLI::App* command =
      app->add_subcommand("gripper", "List the known grippers, print or draw one or one's own");
  command->add_option("GRIPPER", *name, "a known one's name or a TOML file");
  command
      ->add_option("--out", *out,
                   "also write it: its opened boxes as a picture (.png) or a mesh (" +
                       Alternatives(WritableExtensions(), ".") +
                       "), millimetres, or what is printed (.toml)")
      ->needs("GRIPPER");
  command->footer(kAbout);
  command->callback([name, out] {
    if (name->empty()) {
      std::fputs(GripperList().c_str(), stdout);
    } else {
      Gripper(*name, *out);
    }
  });
}

}  // namespace antigrasp
