#include "antigrasp/report/print_report.h"

#include <algorithm>
#include <limits>

#include "antigrasp/export/print_check.h"

namespace antigrasp {
namespace {

bool HasSurface(const TriangleMesh& mesh) {
  return !mesh.faces.empty() &&
         std::all_of(mesh.vertices.begin(), mesh.vertices.end(),
                     [](const Eigen::Vector3d& v) { return v.allFinite(); }) &&
         Bounds(mesh).Extent().maxCoeff() > 0.0;
}

ReportPrint ForReport(const PrintCheck& check) {
  ReportPrint print;
  print.size_mm = check.size_mm;
  print.wall_mm = check.wall_mm.value_or(std::numeric_limits<double>::quiet_NaN());
  print.watertight = check.watertight;
  print.overhang = check.overhang_share;
  if (check.pose_probability > 0.0) {
    print.pose = check.table_from_object;
    print.pose_probability = check.pose_probability;
  } else {
    print.overhang = std::numeric_limits<double>::quiet_NaN();  // of no pose
  }
  print.notes = check.notes;
  return print;
}

}  // namespace

void AddPrintChecks(double size_mm, int threads, RunObserver* observer, Report* report) {
  std::vector<ReportObject*> objects;
  for (ReportObject& object : report->objects) {
    if (HasSurface(object.shape.mesh)) objects.push_back(&object);
  }
  if (objects.empty()) return;
  ParallelFor(
      std::ssize(objects), threads,
      [&](std::int64_t i) {
        ReportObject& object = *objects[static_cast<std::size_t>(i)];
        object.print = ForReport(CheckPrint(object.shape.mesh, size_mm));
      },
      observer->Phase("checking the print"));
}

}  // namespace antigrasp
