#include "antigrasp/mesh/inspect.h"

#include <algorithm>
#include <set>

#include "antigrasp/mesh/nesting.h"
#include "antigrasp/mesh/pieces.h"
#include "antigrasp/mesh/self_intersection.h"
#include "antigrasp/mesh/topology.h"

namespace antigrasp {
namespace {

std::int32_t CornerAt(const TriangleMesh& mesh, std::int32_t face, std::int32_t vertex) {
  int k = 0;
  while (mesh.faces[face][k] != vertex) ++k;
  return 3 * face + k;
}

struct Adjacency {
  ParitySets faces;    // connected by edges, odd = to be turned
  ParitySets corners;  // of one vertex, connected by edges: one set per fan
  int edges = 0;
  explicit Adjacency(std::size_t n) : faces(n), corners(3 * n) {}
};

// Fills the edge properties of the report.
Adjacency ExamineEdges(const TriangleMesh& mesh, MeshReport* report) {
  Adjacency out(mesh.faces.size());
  report->orientable = report->oriented = true;
  ForEachEdge(SortedEdgeUses(mesh), [&](auto first, auto last) {
    ++out.edges;
    const auto uses = last - first;
    if (uses == 1) ++report->boundary_edges;
    if (uses > 2) ++report->nonmanifold_edges;
    for (auto use = first + 1; use != last; ++use) {
      const bool same_direction = use->forward == first->forward;
      if (same_direction) report->oriented = false;
      if (!out.faces.Join(first->face, use->face, same_direction)) report->orientable = false;
      for (const std::int32_t vertex : {first->low, first->high}) {
        out.corners.Join(CornerAt(mesh, first->face, vertex), CornerAt(mesh, use->face, vertex));
      }
    }
  });
  // Three faces cannot all disagree in pairs along their common edge.
  if (report->nonmanifold_edges > 0) report->orientable = report->oriented = false;
  report->closed = report->boundary_edges == 0 && report->nonmanifold_edges == 0;
  return out;
}

// Vertices in use, and whether each has all its corners in one fan.
int CountVertices(const TriangleMesh& mesh, ParitySets* corners, bool* one_fan_each) {
  std::vector<std::int32_t> fan(mesh.vertices.size(), -1);
  int used = 0;
  *one_fan_each = true;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const std::int32_t root = corners->Find(static_cast<std::int32_t>(3 * f) + k).root;
      std::int32_t& first = fan[mesh.faces[f][k]];
      if (first < 0) {
        first = root;
        ++used;
      }
      if (first != root) *one_fan_each = false;
    }
  }
  return used;
}

// Fills the properties of the components. A void lies inside an odd number of others, and faces
// inward; whatever else encloses matter.
void ExamineComponents(const TriangleMesh& mesh, const Pieces& pieces, MeshReport* report) {
  report->components = pieces.count;
  const std::vector<int> depths =
      report->closed ? NestingDepths(mesh, pieces) : std::vector<int>(pieces.count, 0);
  const std::vector<double> six_volume = SixVolumes(mesh, pieces);
  report->outward = report->closed && report->oriented;
  for (std::int32_t p = 0; p < pieces.count; ++p) {
    const bool is_void = depths[p] % 2 == 1;
    report->voids += is_void;
    if (!(is_void ? six_volume[p] < 0.0 : six_volume[p] > 0.0)) report->outward = false;
  }
}

// How many components meet another one.
int CountOverlapping(const TriangleMesh& mesh, const Pieces& pieces) {
  std::set<std::int32_t> overlapping;
  for (const auto& [a, b] : MeetingPieces(mesh, pieces)) {
    if (a != b) overlapping.insert({a, b});
  }
  return static_cast<int>(overlapping.size());
}

std::string Counted(int count, const std::string& singular) {
  return std::to_string(count) + " " + singular + (count == 1 ? "" : "s");
}

}  // namespace

bool IsFinite(const TriangleMesh& mesh) {
  const auto count = static_cast<std::int64_t>(mesh.vertices.size());
  const auto in_range = [&](std::int32_t v) { return v >= 0 && v < count; };
  return std::all_of(mesh.vertices.begin(), mesh.vertices.end(),
                     [](const Eigen::Vector3d& v) { return v.allFinite(); }) &&
         std::all_of(mesh.faces.begin(), mesh.faces.end(), [&](const auto& face) {
           return std::all_of(face.begin(), face.end(), in_range);
         });
}

MeshReport Inspect(const TriangleMesh& mesh, bool check_self_intersection) {
  MeshReport report;
  report.finite = IsFinite(mesh);
  if (!report.finite || mesh.faces.empty()) return report;

  Adjacency adjacency = ExamineEdges(mesh, &report);
  bool one_fan_each = false;
  const int vertices = CountVertices(mesh, &adjacency.corners, &one_fan_each);
  const Pieces pieces = PiecesOf(&adjacency.faces, mesh.faces.size());
  ExamineComponents(mesh, pieces, &report);
  report.manifold = report.closed && one_fan_each;
  if (report.manifold && report.orientable && report.components == 1) {
    // Euler: V - E + F = 2 - 2 genus.
    report.genus = (2 - (vertices - adjacency.edges + static_cast<int>(mesh.faces.size()))) / 2;
  }
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    if (IsDegenerate(mesh, f)) ++report.degenerate_faces;
  }
  report.volume = Volume(mesh);
  report.area = SurfaceArea(mesh);
  report.center_of_mass = CenterOfMass(mesh);
  report.self_intersecting = check_self_intersection && SelfIntersects(mesh);
  if (report.self_intersecting && pieces.count > 1) {
    report.overlapping = CountOverlapping(mesh, pieces);
  }
  return report;
}

std::string WhyNotSolid(const MeshReport& report) {
  if (!report.finite) return "not finite: a coordinate is not a number or an index is out of range";
  if (report.components == 0) return "empty: no faces";
  if (report.boundary_edges > 0) return "open: " + Counted(report.boundary_edges, "boundary edge");
  if (report.nonmanifold_edges > 0) {
    return "non-manifold: " + Counted(report.nonmanifold_edges, "edge") +
           " with more than two faces";
  }
  if (!report.manifold) return "non-manifold: parts touch in a single vertex";
  if (report.overlapping > 0) return "overlapping pieces: " + std::to_string(report.overlapping);
  const int bodies = report.components - report.voids;
  if (bodies > 1) return "disjoint pieces: " + std::to_string(bodies);
  if (!report.orientable) return "not orientable: one-sided surface";
  if (!report.oriented) return "winding not consistent: neighbouring faces disagree";
  if (report.degenerate_faces > 0) {
    return "degenerate: " + Counted(report.degenerate_faces, "face") + " without area";
  }
  if (!(report.volume > 0.0)) return "inside-out: volume not positive";
  if (!report.outward) return "inside-out: a body or a void faces the wrong way";
  if (report.self_intersecting) return "self-intersecting";
  return "";
}

}  // namespace antigrasp
