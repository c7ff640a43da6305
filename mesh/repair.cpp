#include "antigrasp/mesh/repair.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "antigrasp/mesh/clean_faces.h"
#include "antigrasp/mesh/orient.h"
#include "antigrasp/mesh/slivers.h"
#include "antigrasp/mesh/topology.h"
#include "antigrasp/mesh/unite.h"
#include "antigrasp/mesh/weld.h"

namespace antigrasp {
namespace {

// Vertices this close, relative to the diagonal of the bounding box, may be one: about what is left
// of a coordinate that went through float32 or six printed digits.
constexpr double kNearVertices = 1e-7;

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
  if (merged.faces.empty() || CountEdges(merged).boundary > 0) return false;
  result->mesh = std::move(merged);
  SayVertices(&result->actions, "merged", vertices, "nearly equal");
  SayFaces(&result->actions, "removed", lines, "emptied");
  SayCopies(&result->actions, copies, "doubled");
  return true;
}

// Seams that rounding has opened.
void MergeNear(RepairResult* result) {
  if (CountEdges(result->mesh).boundary == 0) return;
  const double near = kNearVertices * Bounds(result->mesh).Extent().norm();
  const double step = Float32Step(result->mesh);
  if (!MergeWithin(near, result) && step > near) MergeWithin(step, result);
}

// Makes neighbours agree, and pieces face outward or, as voids, inward; then pieces that overlap
// become one.
void Orient(RepairResult* result) {
  const bool closed = CountEdges(result->mesh).Closed();
  const Orientation orientation = OrientFaces(&result->mesh, closed);
  if (orientation.turned > 0 && orientation.turned == result->mesh.faces.size()) {
    result->actions.push_back("turned inside out");
  } else {
    SayFaces(&result->actions, "turned", orientation.turned, "wrongly wound");
  }
  const std::size_t united = closed ? UniteGroups(orientation, &result->mesh) : 0;
  Say(&result->actions, "united", united, "overlapping", "piece", "pieces");
}

// Slivers lie on an edge: two faces that they part would count as crossing each other.
void SayFlipped(RepairResult* result) {
  SayFaces(&result->actions, "flipped the long edge of", FlipSlivers(&result->mesh), "zero-area");
}

}  // namespace

RepairResult Repair(const TriangleMesh& mesh) {
  RepairResult result;
  result.mesh = mesh;
  if (IsFinite(mesh)) {
    MergeEqual(&result);
    MergeNear(&result);
    SayFlipped(&result);
    Orient(&result);
  }
  result.report = Inspect(result.mesh);
  result.refusal = WhyNotSolid(result.report);
  return result;
}

}  // namespace antigrasp
