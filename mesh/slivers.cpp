#include "antigrasp/mesh/slivers.h"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "antigrasp/mesh/topology.h"

namespace antigrasp {
namespace {

// One pass settles slivers that are not neighbours, and each further one the next of a chain.
constexpr int kMostSliverPasses = 32;

// One pass of flips. Vertices that took part are left alone afterwards, so that the table of edges
// stays right for the others.
class SliverFlipper {
 public:
  explicit SliverFlipper(TriangleMesh* mesh)
      : mesh_(mesh), uses_(SortedEdgeUses(*mesh)), touched_(mesh->vertices.size(), false) {}

  // Replaces the collinear face (p, q, r), r between p and q, and its neighbour (q, p, d) by
  // (p, d, r) and (q, r, d): the same surface without the sliver, whose winding says nothing.
  bool Flip(std::int32_t face) {
    const int k = LongestSide(face);
    const std::int32_t p = mesh_->faces[face][k], q = mesh_->faces[face][(k + 1) % 3];
    const std::int32_t r = mesh_->faces[face][(k + 2) % 3];
    const auto [first, last] = Uses(p, q);
    if (last - first != 2) return false;
    const std::int32_t other = first->face == face ? (first + 1)->face : first->face;
    const auto& neighbour = mesh_->faces[other];
    int j = 0;
    while (neighbour[j] == p || neighbour[j] == q) ++j;
    const std::int32_t d = neighbour[j];
    const bool backward = neighbour[(j + 1) % 3] == q;
    const auto [taken_first, taken_last] = Uses(r, d);
    if (d == r || taken_first != taken_last) return false;
    if (touched_[p] || touched_[q] || touched_[r] || touched_[d]) return false;
    for (const std::int32_t v : {p, q, r, d}) touched_[v] = true;
    mesh_->faces[face] = {p, d, r};
    mesh_->faces[other] = {q, r, d};
    if (!backward) {
      std::swap(mesh_->faces[face][1], mesh_->faces[face][2]);
      std::swap(mesh_->faces[other][1], mesh_->faces[other][2]);
    }
    return true;
  }

 private:
  using Range =
      std::pair<std::vector<EdgeUse>::const_iterator, std::vector<EdgeUse>::const_iterator>;

  int LongestSide(std::int32_t face) const {
    int longest = 0;
    double length = -1.0;
    for (int k = 0; k < 3; ++k) {
      const auto& f = mesh_->faces[face];
      const double side = (mesh_->vertices[f[(k + 1) % 3]] - mesh_->vertices[f[k]]).norm();
      if (side > length) {
        length = side;
        longest = k;
      }
    }
    return longest;
  }

  Range Uses(std::int32_t a, std::int32_t b) const {
    const EdgeUse key{std::min(a, b), std::max(a, b), 0, false};
    return std::equal_range(uses_.begin(), uses_.end(), key, [](const auto& x, const auto& y) {
      return std::pair(x.low, x.high) < std::pair(y.low, y.high);
    });
  }

  TriangleMesh* mesh_;
  std::vector<EdgeUse> uses_;
  std::vector<bool> touched_;
};

std::vector<std::int32_t> SliversOf(const TriangleMesh& mesh) {
  std::vector<std::int32_t> slivers;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    if (IsDegenerate(mesh, f)) slivers.push_back(static_cast<std::int32_t>(f));
  }
  return slivers;
}

}  // namespace

std::size_t FlipSlivers(TriangleMesh* mesh) {
  std::size_t flipped = 0;
  for (int pass = 0; pass < kMostSliverPasses; ++pass) {
    const std::vector<std::int32_t> slivers = SliversOf(*mesh);
    if (slivers.empty() || !CountEdges(*mesh).Closed()) break;
    const std::size_t before = flipped;
    SliverFlipper flipper(mesh);
    for (const std::int32_t face : slivers) {
      // An earlier flip of this pass may have given it area.
      if (IsDegenerate(*mesh, static_cast<std::size_t>(face))) flipped += flipper.Flip(face);
    }
    if (flipped == before) break;
  }
  return flipped;
}

}  // namespace antigrasp
