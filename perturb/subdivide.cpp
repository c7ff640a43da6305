#include "antigrasp/perturb/subdivide.h"

#include <CGAL/boost/graph/Euler_operations.h>

#include <algorithm>
#include <cmath>
#include <queue>

#include "antigrasp/core/check.h"
#include "antigrasp/core/error.h"
#include "antigrasp/core/format.h"
#include "antigrasp/perturb/surface_mesh.h"

namespace antigrasp {
namespace {

double Diagonal(const TriangleMesh& mesh) { return Bounds(mesh).Extent().norm(); }

// The longest edge first; of equal ones the one that was there first.
class LongEdges {
 public:
  LongEdges(const SurfaceMesh& mesh, double longest) : mesh_(mesh), squared_(longest * longest) {
    for (const auto edge : mesh.edges()) Add(edge);
  }

  void Add(SurfaceMesh::Edge_index edge) {
    const auto h = mesh_.halfedge(edge);
    const double length =
        CGAL::squared_distance(mesh_.point(mesh_.source(h)), mesh_.point(mesh_.target(h)));
    if (length > squared_) queue_.push({length, edge});
  }

  bool empty() const { return queue_.empty(); }

  SurfaceMesh::Edge_index Take() {
    const auto edge = queue_.top().edge;
    queue_.pop();
    return edge;
  }

 private:
  struct Entry {
    double length;
    SurfaceMesh::Edge_index edge;
    bool operator<(const Entry& other) const {
      return length != other.length ? length < other.length : other.edge < edge;
    }
  };
  const SurfaceMesh& mesh_;
  double squared_;
  std::priority_queue<Entry> queue_;
};

}  // namespace

void Bind(OptionTable* table, SubdivideOptions* options) {
  table->Add("perturb.subdivide", &options->longest, 0.0, kAsItIs,
             "split edges that are longer than this, percent of the bounding-box diagonal, the "
             "surface stays; 0 = to 4 where one is longer than 25; 100 = none");
}

void RequireSubdivision(const SubdivideOptions& options, const std::string& origin) {
  if (options.longest <= 0.0 || options.longest >= kLeastEdge) return;
  throw InputError("perturb.subdivide = " + FormatDouble(options.longest), origin,
                   "0 or at least " + FormatDouble(kLeastEdge) + ": millions of faces else");
}

double LongestEdge(const TriangleMesh& mesh) {
  double squared = 0.0;
  for (const auto& face : mesh.faces) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& a = mesh.vertices[static_cast<std::size_t>(face[k])];
      const auto& b = mesh.vertices[static_cast<std::size_t>(face[(k + 1) % 3])];
      squared = std::max(squared, (b - a).squaredNorm());
    }
  }
  return std::sqrt(squared);
}

bool IsCoarse(const TriangleMesh& mesh) {
  return LongestEdge(mesh) > kCoarseEdge / 100.0 * Diagonal(mesh);
}

TriangleMesh SplitLongEdges(const TriangleMesh& mesh, double longest) {
  AG_CHECK(longest > 0.0, "a length");
  SurfaceMesh work = ToSurfaceMesh(mesh);
  LongEdges edges(work, longest);
  while (!edges.empty()) {
    const auto along = work.halfedge(edges.Take());
    const auto middle =
        CGAL::midpoint(work.point(work.source(along)), work.point(work.target(along)));
    const auto first = CGAL::Euler::split_edge(along, work);  // ends in the new corner
    work.point(work.target(first)) = middle;
    const auto back = work.opposite(first);  // begins there
    const auto left = CGAL::Euler::split_face(first, work.next(work.next(first)), work);
    const auto right = CGAL::Euler::split_face(work.prev(back), work.next(back), work);
    for (const auto h : {first, along, left, right}) edges.Add(work.edge(h));
  }
  return FromSurfaceMesh(&work);
}

TriangleMesh Subdivided(const TriangleMesh& mesh, const SubdivideOptions& options) {
  double percent = options.longest;
  if (!(percent > 0.0)) percent = IsCoarse(mesh) ? kFineEdge : kAsItIs;
  const double longest = percent / 100.0 * Diagonal(mesh);
  return LongestEdge(mesh) > longest ? SplitLongEdges(mesh, longest) : mesh;
}

}  // namespace antigrasp
