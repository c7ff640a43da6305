#include "antigrasp/mesh/mesh_text.h"

#include <cstdio>

#include "antigrasp/mesh/inspect.h"

namespace antigrasp {
namespace {

std::string MeshText(const TriangleMesh& mesh) {
  const MeshReport report = Inspect(mesh);
  const Eigen::Vector3d extent = Bounds(mesh).Extent();
  const std::string refusal = WhyNotSolid(report);
  const auto yes = [](bool value) { return value ? "yes" : "no"; };
  char text[400];
  std::snprintf(text, sizeof text,
                "  extent             %g x %g x %g\n"
                "  watertight         %s\n"
                "  winding consistent %s\n"
                "  outward            %s\n"
                "  self-intersecting  %s\n"
                "  components         %d\n",
                extent.x(), extent.y(), extent.z(), yes(report.closed), yes(report.oriented),
                yes(report.outward), yes(report.self_intersecting), report.components);
  std::string lines = text;
  if (report.voids > 0)
    lines += "  closed voids       " + std::to_string(report.voids) + " of them\n";
  std::snprintf(text, sizeof text,
                "  genus              %d\n"
                "  volume             %g\n"
                "  area               %g\n",
                report.genus, report.volume, report.area);
  return lines + text + "  printable solid    " + (refusal.empty() ? "yes" : "no: " + refusal) +
         "\n";
}

}  // namespace

std::string MeshFileText(const MeshFile& file) {
  std::string text = "mesh, " + std::to_string(file.mesh.vertices.size()) + " vertices, " +
                     std::to_string(file.mesh.faces.size()) + " faces\n";
  if (file.unit) text += "  unit               " + file.unit->name + "\n";
  for (const std::string& note : file.notes) text += "  note               " + note + "\n";
  return text + MeshText(file.mesh);
}

}  // namespace antigrasp
