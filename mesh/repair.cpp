#include "antigrasp/mesh/repair.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "antigrasp/mesh/topology.h"
#include "antigrasp/mesh/weld.h"

namespace antigrasp {
namespace {

// Vertices this close, relative to the diagonal of the bounding box, may be one: about what is left
// of a coordinate that went through float32 or six printed digits.
constexpr double kNearVertices = 1e-7;
// One pass settles slivers that are not neighbours, and each further one the next of a chain.
constexpr int kMostSliverPasses = 32;

// "removed 3 degenerate faces"; nothing when it did not happen.
void Say(std::vector<std::string>* actions, const std::string& done, std::size_t count,
         const std::string& kind, const char* one, const char* many) {
  if (count == 0) return;
  actions->push_back(done + " " + std::to_string(count) + " " + kind + " " +
                     (count == 1 ? one : many));
}

void SayFaces(std::vector<std::string>* actions, const std::string& done, std::size_t count,
              const std::string& kind) {
  Say(actions, done, count, kind, "face", "faces");
}

void SayVertices(std::vector<std::string>* actions, const std::string& done, std::size_t count,
                 const std::string& kind) {
  Say(actions, done, count, kind, "vertex", "vertices");
}

void Redirect(const std::vector<std::int32_t>& first, TriangleMesh* mesh) {
  for (auto& face : mesh->faces) {
    for (std::int32_t& v : face) v = first[v];
  }
}

// Returns how many went.
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

// A face with a repeated vertex is a line: nothing is lost with it, not even closedness.
std::size_t DropLines(TriangleMesh* mesh) {
  return DropFaces(mesh, [&](std::size_t f) {
    const auto& [a, b, c] = mesh->faces[f];
    return a == b || b == c || c == a;
  });
}

// Keeps the first of the faces on the same three vertices, in whatever order.
std::size_t DropDuplicates(TriangleMesh* mesh) {
  std::vector<std::pair<std::array<std::int32_t, 3>, std::size_t>> keys(mesh->faces.size());
  for (std::size_t f = 0; f < keys.size(); ++f) {
    keys[f] = {mesh->faces[f], f};
    std::sort(keys[f].first.begin(), keys[f].first.end());
  }
  std::sort(keys.begin(), keys.end());
  std::vector<bool> repeated(keys.size(), false);
  for (std::size_t i = 1; i < keys.size(); ++i) {
    if (keys[i].first == keys[i - 1].first) repeated[keys[i].second] = true;
  }
  return DropFaces(mesh, [&](std::size_t f) { return repeated[f]; });
}

void MergeEqual(RepairResult* result) {
  TriangleMesh& mesh = result->mesh;
  const std::vector<std::int32_t> first = FirstEqual(mesh.vertices);
  std::size_t merged = 0;
  for (std::size_t i = 0; i < first.size(); ++i) merged += first[i] != static_cast<int>(i);
  Redirect(first, &mesh);
  SayVertices(&result->actions, "merged", merged, "duplicate");
  SayFaces(&result->actions, "removed", DropLines(&mesh), "degenerate");
  SayFaces(&result->actions, "removed", DropDuplicates(&mesh), "duplicate");
  // The merged ones are unused now, too, and have been told of.
  SayVertices(&result->actions, "removed", DropUnusedVertices(&mesh) - merged, "unused");
}

// Seams that rounding has opened. Only when that closes the mesh: merging is then a repair, and
// not a guess.
void MergeNear(RepairResult* result) {
  if (Inspect(result->mesh, false).boundary_edges == 0) return;
  TriangleMesh merged = result->mesh;
  const double tolerance = kNearVertices * Bounds(merged).Extent().norm();
  Redirect(FirstNear(merged.vertices, tolerance), &merged);
  const std::size_t lines = DropLines(&merged);
  const std::size_t duplicates = DropDuplicates(&merged);
  const std::size_t vertices = DropUnusedVertices(&merged);
  if (merged.faces.empty() || Inspect(merged, false).boundary_edges > 0) return;
  result->mesh = std::move(merged);
  SayVertices(&result->actions, "merged", vertices, "nearly equal");
  SayFaces(&result->actions, "removed", lines, "emptied");
  SayFaces(&result->actions, "removed", duplicates, "doubled");
}

// Makes neighbours agree, then every component enclose a positive volume.
void Orient(RepairResult* result) {
  TriangleMesh& mesh = result->mesh;
  const bool closed = Inspect(mesh, false).closed;
  ParitySets sets(mesh.faces.size());
  ForEachEdge(SortedEdgeUses(mesh), [&](auto first, auto last) {
    // More than two faces say nothing about which two belong together.
    if (last - first != 2) return;
    sets.Join(first->face, (first + 1)->face, first->forward == (first + 1)->forward);
  });
  const Eigen::Vector3d origin = Bounds(mesh).Center();
  std::vector<double> six_volume(mesh.faces.size(), 0.0);
  std::vector<int> surplus(mesh.faces.size(), 0);  // faces of parity even, less those of parity odd
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto [root, odd] = sets.Find(static_cast<std::int32_t>(f));
    const double part = (mesh.vertices[mesh.faces[f][0]] - origin).dot(FaceCross(mesh, f));
    six_volume[root] += odd ? -part : part;
    surplus[root] += odd ? -1 : 1;
  }
  std::size_t turned = 0;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto [root, odd] = sets.Find(static_cast<std::int32_t>(f));
    // An open component has no outside: the majority of its faces is right.
    const bool turn_even = closed ? six_volume[root] < 0.0 : surplus[root] < 0;
    if (odd == turn_even) continue;
    std::swap(mesh.faces[f][1], mesh.faces[f][2]);
    ++turned;
  }
  if (turned > 0 && turned == mesh.faces.size()) {
    result->actions.push_back("turned inside out");
  } else {
    SayFaces(&result->actions, "turned", turned, "wrongly wound");
  }
}

// One pass of flips. Vertices that took part are left alone afterwards, so that the table of edges
// stays right for the others.
class SliverFlipper {
 public:
  explicit SliverFlipper(TriangleMesh* mesh)
      : mesh_(mesh), uses_(SortedEdgeUses(*mesh)), touched_(mesh->vertices.size(), false) {}

  // Replaces the collinear face (p, q, r), r between p and q, and its neighbour (q, p, d) by
  // (p, d, r) and (q, r, d): the same surface without the sliver.
  bool Flip(std::int32_t face) {
    const int k = LongestSide(face);
    const std::int32_t p = mesh_->faces[face][k], q = mesh_->faces[face][(k + 1) % 3];
    const std::int32_t r = mesh_->faces[face][(k + 2) % 3];
    const auto [first, last] = Uses(p, q);
    if (last - first != 2) return false;
    const std::int32_t other = first->face == face ? (first + 1)->face : first->face;
    const auto& neighbour = mesh_->faces[other];
    int j = 0;
    while (j < 3 && !(neighbour[j] == q && neighbour[(j + 1) % 3] == p)) ++j;
    if (j == 3) return false;  // wound differently
    const std::int32_t d = neighbour[(j + 2) % 3];
    const auto [taken_first, taken_last] = Uses(r, d);
    if (d == r || taken_first != taken_last) return false;
    if (touched_[p] || touched_[q] || touched_[r] || touched_[d]) return false;
    for (const std::int32_t v : {p, q, r, d}) touched_[v] = true;
    mesh_->faces[face] = {p, d, r};
    mesh_->faces[other] = {q, r, d};
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

// Slivers of a closed mesh; where nothing but a hole could come of it they stay, and are reported.
void FlipSlivers(RepairResult* result) {
  std::size_t flipped = 0;
  for (int pass = 0; pass < kMostSliverPasses; ++pass) {
    const MeshReport report = Inspect(result->mesh, false);
    if (!report.closed || !report.oriented || report.degenerate_faces == 0) break;
    const std::size_t before = flipped;
    SliverFlipper flipper(&result->mesh);
    for (std::size_t f = 0; f < result->mesh.faces.size(); ++f) {
      if (IsDegenerate(result->mesh, f)) flipped += flipper.Flip(static_cast<std::int32_t>(f));
    }
    if (flipped == before) break;
  }
  SayFaces(&result->actions, "flipped the long edge of", flipped, "zero-area");
}

}  // namespace

RepairResult Repair(const TriangleMesh& mesh) {
  RepairResult result;
  result.mesh = mesh;
  if (Inspect(mesh, false).finite) {
    MergeEqual(&result);
    MergeNear(&result);
    Orient(&result);
    FlipSlivers(&result);
  }
  result.report = Inspect(result.mesh);
  result.refusal = WhyNotSolid(result.report);
  return result;
}

}  // namespace antigrasp
