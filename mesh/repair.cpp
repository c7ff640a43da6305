#include "antigrasp/mesh/repair.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "antigrasp/mesh/clean_faces.h"
#include "antigrasp/mesh/orient.h"
#include "antigrasp/mesh/topology.h"
#include "antigrasp/mesh/unite.h"
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

void SayCopies(std::vector<std::string>* actions, const DroppedCopies& copies, const char* kind) {
  SayFaces(actions, "removed", copies.duplicates, kind);
  SayFaces(actions, "removed", copies.cancelled, "cancelling");
}

void MergeEqual(RepairResult* result) {
  TriangleMesh& mesh = result->mesh;
  const std::vector<std::int32_t> first = FirstEqual(mesh.vertices);
  std::size_t merged = 0;
  for (std::size_t i = 0; i < first.size(); ++i) merged += first[i] != static_cast<int>(i);
  Redirect(first, &mesh);
  SayVertices(&result->actions, "merged", merged, "duplicate");
  SayFaces(&result->actions, "removed", DropLines(&mesh), "degenerate");
  SayCopies(&result->actions, DropCopies(&mesh), "duplicate");
  // The merged ones are unused now, too, and have been told of.
  SayVertices(&result->actions, "removed", DropUnusedVertices(&mesh) - merged, "unused");
}

// How far apart one step of float32 leaves copies of a corner: it grows with the coordinate, so
// this is for the mesh where its file has it.
double Float32Step(const TriangleMesh& mesh) {
  const BoundingBox box = Bounds(mesh);
  const Eigen::Vector3d largest = box.min.cwiseAbs().cwiseMax(box.max.cwiseAbs());
  Eigen::Vector3d step;
  for (int k = 0; k < 3; ++k) {
    const auto value = static_cast<float>(largest[k]);
    step[k] = std::nextafter(value, std::numeric_limits<float>::infinity()) - value;
  }
  return (1.0 + kNearVertices) * step.norm();  // a step counts as one when it is rounded, too
}

// Merges vertices nearer than the tolerance, if that closes the mesh: merging is then a repair, and
// not a guess.
bool MergeWithin(double tolerance, RepairResult* result) {
  TriangleMesh merged = result->mesh;
  Redirect(FirstNear(merged.vertices, tolerance), &merged);
  const std::size_t lines = DropLines(&merged);
  const DroppedCopies copies = DropCopies(&merged);
  const std::size_t vertices = DropUnusedVertices(&merged);
  if (merged.faces.empty() || Inspect(merged, false).boundary_edges > 0) return false;
  result->mesh = std::move(merged);
  SayVertices(&result->actions, "merged", vertices, "nearly equal");
  SayFaces(&result->actions, "removed", lines, "emptied");
  SayCopies(&result->actions, copies, "doubled");
  return true;
}

// Seams that rounding has opened.
void MergeNear(RepairResult* result) {
  if (Inspect(result->mesh, false).boundary_edges == 0) return;
  const double near = kNearVertices * Bounds(result->mesh).Extent().norm();
  const double step = Float32Step(result->mesh);
  if (!MergeWithin(near, result) && step > near) MergeWithin(step, result);
}

// Makes neighbours agree, and pieces face outward or, as voids, inward; then pieces that overlap
// become one.
void Orient(RepairResult* result) {
  const bool closed = Inspect(result->mesh, false).closed;
  const Orientation orientation = OrientFaces(&result->mesh, closed);
  if (orientation.turned > 0 && orientation.turned == result->mesh.faces.size()) {
    result->actions.push_back("turned inside out");
  } else {
    SayFaces(&result->actions, "turned", orientation.turned, "wrongly wound");
  }
  const std::size_t united = closed ? UniteGroups(orientation, &result->mesh) : 0;
  Say(&result->actions, "united", united, "overlapping", "piece", "pieces");
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
