#include "antigrasp/perturb/certificate.h"

#include <cstdio>

#include "antigrasp/core/error.h"
#include "antigrasp/core/format.h"
#include "antigrasp/mesh/inspect.h"

namespace antigrasp {

AdversarialPolyhedron RequestedPolyhedron(Polyhedron kind, const PolyhedronOptions& options,
                                          int threads, const ProgressFn& progress) {
  if (!(options.phi >= 0.0 && options.phi <= kBestAntipodality)) {
    throw InputError(
        "phi = " + FormatDouble(options.phi), "--phi",
        "at most 70.5288 degrees, the regular tetrahedron's: no closed solid has more");
  }
  AdversarialPolyhedron solid = MakeAdversarialPolyhedron(kind, options, threads, progress);
  if (solid.reached) return solid;
  char best[32];
  std::snprintf(best, sizeof best, "%.4f", solid.antipodality.degrees);
  throw InputError("phi = " + FormatDouble(options.phi) + " is out of reach",
                   "shape " + ChoiceName(kind),
                   std::string("at most ") + best + " degrees, the best reached");
}

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
