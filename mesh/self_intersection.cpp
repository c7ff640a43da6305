// CGAL's headers cost far more to compile than everything else here: they are seen by this file,
// nesting.cpp, mesh_union.cpp and convex_hull.cpp alone.
#include "antigrasp/mesh/self_intersection.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>
#include <CGAL/intersections.h>

#include <algorithm>
#include <array>
#include <vector>

namespace antigrasp {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Triangle = Kernel::Triangle_3;
using Segment = Kernel::Segment_3;
using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::size_t>;

struct Found {};  // thrown to leave CGAL's box traversal at the first intersection

class FacePairTest {
 public:
  explicit FacePairTest(const TriangleMesh& mesh) : mesh_(mesh) {
    points_.reserve(mesh.vertices.size());
    for (const auto& v : mesh.vertices) points_.emplace_back(v.x(), v.y(), v.z());
  }

  std::vector<Box> Boxes() const {
    std::vector<Box> boxes;
    for (std::size_t f = 0; f < mesh_.faces.size(); ++f) {
      const auto [a, b, c] = mesh_.faces[f];
      if (CGAL::collinear(points_[a], points_[b], points_[c])) continue;
      boxes.emplace_back(points_[a].bbox() + points_[b].bbox() + points_[c].bbox(), f);
    }
    return boxes;
  }

  bool Intersect(std::size_t first, std::size_t second) const {
    // Rotate both faces so that shared vertices come first.
    const auto& f = mesh_.faces[first];
    const auto& g = mesh_.faces[second];
    std::array<std::array<int, 2>, 3> shared{};
    int count = 0;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        if (f[i] == g[j]) shared[count++] = {i, j};
      }
    }
    if (count == 3) return true;
    if (count == 2) return FoldedFlat(f, g, shared[0], shared[1]);
    const Triangle t(points_[f[0]], points_[f[1]], points_[f[2]]);
    const Triangle u(points_[g[0]], points_[g[1]], points_[g[2]]);
    if (count == 0) return CGAL::do_intersect(t, u);
    // They share one corner. Anything more they share reaches the far side of one of them.
    const auto [i, j] = shared[0];
    return CGAL::do_intersect(t, Segment(points_[g[(j + 1) % 3]], points_[g[(j + 2) % 3]])) ||
           CGAL::do_intersect(u, Segment(points_[f[(i + 1) % 3]], points_[f[(i + 2) % 3]]));
  }

 private:
  using Face = std::array<std::int32_t, 3>;

  // Two faces on one edge overlap only when they lie in one plane on the same side of it.
  bool FoldedFlat(const Face& f, const Face& g, const std::array<int, 2>& s,
                  const std::array<int, 2>& t) const {
    const Point& a = points_[f[s[0]]];
    const Point& b = points_[f[t[0]]];
    const Point& c = points_[f[3 - s[0] - t[0]]];
    const Point& d = points_[g[3 - s[1] - t[1]]];
    return CGAL::coplanar(a, b, c, d) && CGAL::coplanar_orientation(a, b, c, d) == CGAL::POSITIVE;
  }

  const TriangleMesh& mesh_;
  std::vector<Point> points_;
};

}  // namespace

bool SelfIntersects(const TriangleMesh& mesh) {
  const FacePairTest test(mesh);
  std::vector<Box> boxes = test.Boxes();
  try {
    CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Box& a, const Box& b) {
      if (test.Intersect(a.info(), b.info())) throw Found{};
    });
  } catch (const Found&) {
    return true;
  }
  return false;
}

std::set<std::pair<std::int32_t, std::int32_t>> MeetingPieces(const TriangleMesh& mesh,
                                                              const Pieces& pieces) {
  const FacePairTest test(mesh);
  std::vector<Box> boxes = test.Boxes();
  std::set<std::pair<std::int32_t, std::int32_t>> meeting;
  CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Box& a, const Box& b) {
    const auto pair = std::minmax(pieces.of_face[a.info()], pieces.of_face[b.info()]);
    if (!meeting.contains(pair) && test.Intersect(a.info(), b.info())) meeting.insert(pair);
  });
  return meeting;
}

}  // namespace antigrasp
