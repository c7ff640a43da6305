#include "antigrasp/mesh/topology.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace antigrasp {
namespace {

// A height this far below the longest edge is what rounding leaves of three collinear points.
constexpr double kZeroHeight = 1e-12;

}  // namespace

// Sorted into their lower vertices first, which leaves a few to compare.
std::vector<EdgeUse> SortedEdgeUses(const TriangleMesh& mesh) {
  std::vector<std::size_t> end(mesh.vertices.size() + 1, 0);  // of the uses of a lower vertex
  const auto for_each_use = [&](const auto& visit) {
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
      for (int k = 0; k < 3; ++k) {
        const std::int32_t from = mesh.faces[f][k];
        const std::int32_t to = mesh.faces[f][(k + 1) % 3];
        visit(EdgeUse{std::min(from, to), std::max(from, to), static_cast<std::int32_t>(f),
                      from <= to});
      }
    }
  };
  for_each_use([&](const EdgeUse& use) { ++end[use.low + 1]; });
  std::partial_sum(end.begin(), end.end(), end.begin());
  std::vector<EdgeUse> uses(3 * mesh.faces.size());
  for_each_use([&](const EdgeUse& use) { uses[end[use.low]++] = use; });
  std::size_t begin = 0;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    std::sort(uses.begin() + begin, uses.begin() + end[v], [](const EdgeUse& a, const EdgeUse& b) {
      return std::tie(a.high, a.face, a.forward) < std::tie(b.high, b.face, b.forward);
    });
    begin = end[v];
  }
  return uses;
}

EdgeCounts CountEdges(const TriangleMesh& mesh) {
  EdgeCounts counts;
  ForEachEdge(SortedEdgeUses(mesh), [&](auto first, auto last) {
    ++counts.edges;
    counts.boundary += last - first == 1;
    counts.nonmanifold += last - first > 2;
  });
  return counts;
}

ParitySets::ParitySets(std::size_t count) : nodes_(count) {
  for (std::size_t i = 0; i < count; ++i) nodes_[i].parent = static_cast<std::int32_t>(i);
}

ParitySets::Place ParitySets::Find(std::int32_t item) {
  // First up to the root, then once more to hang every node of the path directly below it.
  std::int32_t root = item;
  bool odd = false;
  while (nodes_[root].parent != root) {
    odd ^= nodes_[root].odd;
    root = nodes_[root].parent;
  }
  const Place place{root, odd};
  while (nodes_[item].parent != item) {
    Node& node = nodes_[item];
    item = node.parent;
    node.parent = root;
    const bool step = node.odd;
    node.odd = odd;
    odd ^= step;
  }
  return place;
}

bool ParitySets::Join(std::int32_t a, std::int32_t b, bool odd) {
  Place pa = Find(a);
  Place pb = Find(b);
  if (pa.root == pb.root) return (pa.odd ^ pb.odd) == odd;
  if (nodes_[pa.root].size < nodes_[pb.root].size) std::swap(pa, pb);
  nodes_[pa.root].size += nodes_[pb.root].size;
  nodes_[pb.root].parent = pa.root;
  nodes_[pb.root].odd = pa.odd ^ pb.odd ^ odd;
  return true;
}

bool IsDegenerate(const TriangleMesh& mesh, std::size_t face) {
  const auto& [a, b, c] = mesh.faces[face];
  if (a == b || b == c || c == a) return true;
  const auto& v = mesh.vertices;
  const double longest = std::max(
      {(v[b] - v[a]).squaredNorm(), (v[c] - v[b]).squaredNorm(), (v[a] - v[c]).squaredNorm()});
  return !(FaceCross(mesh, face).norm() > kZeroHeight * longest);
}

}  // namespace antigrasp
