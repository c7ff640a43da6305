#include <cstdio>
#include <filesystem>
#include <memory>

#include "antigrasp/app/commands.h"
#include "antigrasp/app/network_commands.h"
#include "antigrasp/core/error.h"
#include "antigrasp/datasets/shape_set.h"
#include "antigrasp/mesh/inspect.h"
#include "antigrasp/mesh/mesh_file.h"

namespace antigrasp {
namespace {

namespace fs = std::filesystem;

void DescribeShapeSet(const fs::path& path) {
  const ShapeSetInfo info = ReadShapeSetInfo(path);
  std::printf("%s: antigrasp SDF file, version %d\n", path.c_str(), info.version);
  std::printf("  kind        %s\n  shapes      %d of %d^3\n", info.kind.c_str(), info.count,
              info.n);
  std::printf("  spacing     %g (unit cube), positive inside\n", info.spacing);
  if (info.truncation > 0) {
    std::printf("  values      clamped to +-%g\n", info.truncation);
  } else {
    std::printf("  values      exact distances\n");
  }
  std::printf("  seed        %llu\n  provenance  %s\n", static_cast<unsigned long long>(info.seed),
              info.provenance.c_str());
}

void DescribeMesh(const fs::path& path) {
  const TriangleMesh mesh = ReadMesh(path);
  const MeshReport report = Inspect(mesh);
  const Eigen::Vector3d extent = Bounds(mesh).Extent();
  const std::string refusal = WhyNotSolid(report);
  const auto yes = [](bool value) { return value ? "yes" : "no"; };
  std::printf("%s: mesh, %zu vertices, %zu faces\n", path.c_str(), mesh.vertices.size(),
              mesh.faces.size());
  std::printf("  extent             %g x %g x %g\n", extent.x(), extent.y(), extent.z());
  std::printf("  watertight         %s\n  winding consistent %s\n  outward            %s\n",
              yes(report.closed), yes(report.oriented), yes(report.outward));
  std::printf("  self-intersecting  %s\n  components         %d\n  genus              %d\n",
              yes(report.self_intersecting), report.components, report.genus);
  std::printf("  volume             %g\n  area               %g\n", report.volume, report.area);
  std::printf("  printable solid    %s\n", refusal.empty() ? "yes" : ("no: " + refusal).c_str());
}

void Describe(const std::string& input) {
  const fs::path path(input);
  if (fs::is_regular_file(path) && IsShapeSet(path)) {
    DescribeShapeSet(path);
  } else if (fs::is_regular_file(path) && IsMeshFile(path)) {
    DescribeMesh(path);
  } else {
    BecomeNetworks();
  }
}

}  // namespace

void AddInfoCommand(CLI::App* app) {
  const auto path = std::make_shared<std::string>();
  CLI::App* command = app->add_subcommand("info", "Say what a file or run folder is");
  command->add_option("FILE", *path, "SDF file, checkpoint, mesh or run folder")->required();
  command->callback([path] { Describe(*path); });
}

}  // namespace antigrasp
