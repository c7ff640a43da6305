#include <algorithm>
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

void PrintKnownGrippers() {
  std::printf("%-12s %8s  %-19s %-16s %-19s %s\n", "name, mm", "opening", "finger w x t x l",
              "beyond the grasp", "palm l x w x d", "");
  for (const NamedGripper& gripper : NamedGrippers()) {
    const GripperModel& m = gripper.model;
    const auto sizes = [](double a, double b, double c) {
      char text[64];
      std::snprintf(text, sizeof text, "%.4g x %.4g x %.4g", kMillimetres * a, kMillimetres * b,
                    kMillimetres * c);
      return std::string(text);
    };
    std::printf(
        "%-12s %8.4g  %-19s %-16.4g %-19s %s\n", std::string(gripper.name).c_str(),
        kMillimetres * gripper.jaw_opening,
        sizes(m.finger_width, m.finger_thickness, m.palm_distance + m.fingertip_overlap).c_str(),
        kMillimetres * m.fingertip_overlap,
        sizes(m.palm_length, m.palm_width, m.palm_depth).c_str(),
        std::string(gripper.about).c_str());
  }
}

std::string AboutOf(const std::string& name) {
  for (const NamedGripper& gripper : NamedGrippers()) {
    if (gripper.name == name) {
      return std::string(gripper.about) + "; sources: docs/grippers.md. Metres";
    }
  }
  return name + ". Metres";
}

// As it stands above a table: the approach points down.
TriangleMesh PointingDown(TriangleMesh mesh) {
  for (Eigen::Vector3d& v : mesh.vertices) v = {v.y(), -v.z(), -v.x()};
  return mesh;
}

void Gripper(const std::string& name, const std::string& out) {
  MetricOptions metric;
  ApplyGripper(name, &metric);
  RequireFittingGripper(metric, name);
  const std::string toml = GripperToml(metric, AboutOf(name));
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
      PrintKnownGrippers();
    } else {
      Gripper(*name, *out);
    }
  });
}

}  // namespace antigrasp
