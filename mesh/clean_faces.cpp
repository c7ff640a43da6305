#include "antigrasp/mesh/clean_faces.h"

#include <algorithm>
#include <array>
#include <utility>

#include "antigrasp/mesh/pieces.h"
#include "antigrasp/mesh/topology.h"

namespace antigrasp {
namespace {

template <typename Drop>
std::size_t DropFaces(TriangleMesh* mesh, const Drop& drop) {
  std::size_t kept = 0;
  for (std::size_t f = 0; f < mesh->faces.size(); ++f) {
    if (!drop(f)) mesh->faces[kept++] = mesh->faces[f];
  }
  const std::size_t dropped = mesh->faces.size() - kept;
  mesh->faces.resize(kept);
  return dropped;
}

// A face by its corners in ascending order, whatever its winding.
struct SortedCorners {
  std::array<std::int32_t, 3> sorted;
  std::size_t face;
  bool even;  // an even permutation away from the face's own order

  SortedCorners(const TriangleMesh& mesh, std::size_t f) : sorted(mesh.faces[f]), face(f) {
    const auto& [a, b, c] = sorted;
    even = ((a < b) + (b < c) + (c < a)) == 2;
    std::sort(sorted.begin(), sorted.end());
  }
};

// Drops the copies. Which faces had a copy of the other winding is left in `opposed`.
std::size_t KeepFirsts(TriangleMesh* mesh, std::vector<bool>* opposed) {
  std::vector<SortedCorners> keys;
  keys.reserve(mesh->faces.size());
  for (std::size_t f = 0; f < mesh->faces.size(); ++f) keys.emplace_back(*mesh, f);
  std::sort(keys.begin(), keys.end(), [](const SortedCorners& a, const SortedCorners& b) {
    return std::pair(a.sorted, a.face) < std::pair(b.sorted, b.face);
  });
  std::vector<bool> repeated(keys.size(), false), facing(keys.size(), false);
  for (std::size_t first = 0, i = 1; i < keys.size(); ++i) {
    if (keys[i].sorted != keys[first].sorted) {
      first = i;
      continue;
    }
    repeated[keys[i].face] = true;
    if (keys[i].even != keys[first].even) facing[keys[first].face] = true;
  }
  opposed->clear();
  for (std::size_t f = 0; f < keys.size(); ++f) {
    if (!repeated[f]) opposed->push_back(facing[f]);
  }
  return DropFaces(mesh, [&](std::size_t f) { return repeated[f]; });
}

// Which faces belong to a patch of opposed ones whose edges are closed without it. A body whose
// every face is there twice has no such edge, and stays.
std::vector<bool> ClosedWithout(const TriangleMesh& mesh, const std::vector<bool>& opposed) {
  const std::vector<EdgeUse> uses = SortedEdgeUses(mesh);
  ParitySets sets(mesh.faces.size());
  ForEachEdge(uses, [&](auto first, auto last) {
    auto before = last;
    for (auto use = first; use != last; ++use) {
      if (!opposed[use->face]) continue;
      if (before != last) sets.Join(before->face, use->face);
      before = use;
    }
  });
  const Pieces patches = PiecesOf(&sets, mesh.faces.size());
  std::vector<bool> ends(patches.count, false), stays(patches.count, false);
  ForEachEdge(uses, [&](auto first, auto last) {
    const auto inside =
        std::count_if(first, last, [&](const EdgeUse& u) { return opposed[u.face]; });
    if (inside == 0) return;
    const auto at = std::find_if(first, last, [&](const EdgeUse& u) { return opposed[u.face]; });
    const std::int32_t patch = patches.of_face[at->face];
    const auto others = (last - first) - inside;
    if (inside % 2 == 1) ends[patch] = true;
    if (others % 2 == 1 || (inside % 2 == 1 && others == 0)) stays[patch] = true;
  });
  std::vector<bool> closed(mesh.faces.size());
  for (std::size_t f = 0; f < closed.size(); ++f) {
    const std::int32_t patch = patches.of_face[f];
    closed[f] = opposed[f] && ends[patch] && !stays[patch];
  }
  return closed;
}

}  // namespace

void Redirect(const std::vector<std::int32_t>& place, TriangleMesh* mesh) {
  for (auto& face : mesh->faces) {
    for (std::int32_t& v : face) v = place[v];
  }
}

std::size_t DropUnusedVertices(TriangleMesh* mesh) {
  std::vector<std::int32_t> place(mesh->vertices.size(), -1);
  for (const auto& face : mesh->faces) {
    for (const std::int32_t v : face) place[v] = 0;
  }
  std::vector<Eigen::Vector3d> used;
  for (std::size_t i = 0; i < place.size(); ++i) {
    if (place[i] < 0) continue;
    place[i] = static_cast<std::int32_t>(used.size());
    used.push_back(mesh->vertices[i]);
  }
  const std::size_t dropped = mesh->vertices.size() - used.size();
  mesh->vertices = std::move(used);
  Redirect(place, mesh);
  return dropped;
}

std::size_t DropLines(TriangleMesh* mesh) {
  return DropFaces(mesh, [&](std::size_t f) {
    const auto& [a, b, c] = mesh->faces[f];
    return a == b || b == c || c == a;
  });
}

DroppedCopies DropCopies(TriangleMesh* mesh) {
  std::vector<bool> opposed;
  DroppedCopies dropped;
  dropped.duplicates = KeepFirsts(mesh, &opposed);
  if (std::find(opposed.begin(), opposed.end(), true) == opposed.end()) return dropped;
  const std::vector<bool> closed = ClosedWithout(*mesh, opposed);
  const std::size_t patches = DropFaces(mesh, [&](std::size_t f) { return closed[f]; });
  dropped.duplicates -= patches;
  dropped.cancelled = 2 * patches;
  return dropped;
}

}  // namespace antigrasp
