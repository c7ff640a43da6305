#include "antigrasp/perturb/certificate.h"

#include <cstdio>

#include "antigrasp/mesh/inspect.h"

namespace antigrasp {

std::string CertificateText(const AdversarialPolyhedron& solid, double phi) {
  const MeshReport report = Inspect(solid.mesh);
  const std::string flaw = WhyNotSolid(report);
  const Eigen::Vector3d extent = Bounds(solid.mesh).Extent();
  char text[900];
  std::snprintf(text, sizeof text,
                "%zu vertices, %zu faces\n"
                "smallest antipodality angle  %.4f degrees, of faces %zu and %zu (asked for: %g)\n"
                "convex                       %s\n"
                "closed                       %s\n"
                "printable                    %s\n"
                "moved from the plain solid   at most %.2f %% of its size, %.2f %% rms\n"
                "extents                      %.2f x %.2f x %.2f mm, %.2f cm^3\n",
                solid.mesh.vertices.size(), solid.mesh.faces.size(), solid.antipodality.degrees,
                solid.antipodality.first, solid.antipodality.second, phi,
                IsConvex(solid.mesh) ? "yes" : "no", report.closed ? "yes" : "no",
                flaw.empty() ? "yes" : ("no: " + flaw).c_str(), 100.0 * solid.largest_move,
                100.0 * solid.rms_move, extent.x(), extent.y(), extent.z(), report.volume / 1000.0);
  return text;
}

}  // namespace antigrasp
