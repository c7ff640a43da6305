#include "antigrasp/mesh/orient.h"

#include <numeric>

#include "antigrasp/mesh/nesting.h"
#include "antigrasp/mesh/self_intersection.h"
#include "antigrasp/mesh/topology.h"

namespace antigrasp {
namespace {

// Fills which pieces meet.
void GroupPieces(const TriangleMesh& mesh, Orientation* out) {
  const Pieces& pieces = out->pieces;
  ParitySets sets(static_cast<std::size_t>(pieces.count));
  for (const auto& [a, b] : MeetingPieces(mesh, pieces)) {
    if (a == b) out->crosses_itself[a] = true;
    sets.Join(a, b);
  }
  out->group = PiecesOf(&sets, static_cast<std::size_t>(pieces.count)).of_face;
}

}  // namespace

Orientation OrientFaces(TriangleMesh* mesh, bool closed) {
  const std::size_t n = mesh->faces.size();
  ParitySets sets(n);
  ForEachEdge(SortedEdgeUses(*mesh), [&](auto first, auto last) {
    // More than two faces say nothing about which two belong together.
    if (last - first != 2) return;
    sets.Join(first->face, (first + 1)->face, first->forward == (first + 1)->forward);
  });
  Orientation out;
  out.pieces = PiecesOf(&sets, n);
  const auto count = static_cast<std::size_t>(out.pieces.count);
  out.group.resize(count);
  std::iota(out.group.begin(), out.group.end(), 0);
  out.crosses_itself.assign(count, false);
  if (closed && count > 1) GroupPieces(*mesh, &out);
  const std::vector<int> depth =
      closed ? NestingDepths(*mesh, out.pieces, out.group) : std::vector<int>(count, 0);

  const Eigen::Vector3d origin = Bounds(*mesh).Center();
  std::vector<double> six_volume(count, 0.0);
  std::vector<int> surplus(count, 0);  // faces of parity even, less those of parity odd
  for (std::size_t f = 0; f < n; ++f) {
    const std::int32_t piece = out.pieces.of_face[f];
    const bool odd = sets.Find(static_cast<std::int32_t>(f)).odd;
    const double part = (mesh->vertices[mesh->faces[f][0]] - origin).dot(FaceCross(*mesh, f));
    six_volume[piece] += odd ? -part : part;
    surplus[piece] += odd ? -1 : 1;
  }
  for (std::size_t p = 0; p < count; ++p) {
    out.inward.push_back((six_volume[p] < 0.0) != (surplus[p] < 0));
  }
  for (std::size_t f = 0; f < n; ++f) {
    const std::int32_t piece = out.pieces.of_face[f];
    const bool odd = sets.Find(static_cast<std::int32_t>(f)).odd;
    // An open component has no outside: the majority of its faces is right.
    const bool turn_even =
        closed ? (six_volume[piece] < 0.0) != (depth[piece] % 2 == 1) : surplus[piece] < 0;
    if (odd == turn_even) continue;
    std::swap(mesh->faces[f][1], mesh->faces[f][2]);
    ++out.turned;
  }
  return out;
}

}  // namespace antigrasp
