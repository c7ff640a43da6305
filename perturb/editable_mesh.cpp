#include "antigrasp/perturb/editable_mesh.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "antigrasp/core/check.h"
#include "antigrasp/mesh/face_intersection.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

// A full turn allows everything, a face without area (its normal is zero) included.
double CosineOfLimit(double angle) { return angle >= std::numbers::pi ? -2.0 : std::cos(angle); }

double Height(const FaceShape& shape) {
  return FaceHeight(shape.corner[0], shape.corner[1], shape.corner[2]);
}

TriangleMesh Checked(const TriangleMesh& mesh) {
  TriangleMesh out = InSinglePrecision(mesh);
  const auto count = static_cast<std::int64_t>(mesh.vertices.size());
  for (const Vector3d& v : out.vertices) AG_CHECK(v.allFinite(), "a finite vertex");
  for (const auto& face : out.faces) {
    for (const std::int32_t v : face) AG_CHECK(v >= 0 && v < count, "a corner in range");
  }
  return out;
}

void MergeSorted(const std::vector<std::int32_t>& more, std::vector<std::int32_t>* into) {
  std::vector<std::int32_t> merged;
  std::set_union(into->begin(), into->end(), more.begin(), more.end(), std::back_inserter(merged));
  *into = std::move(merged);
}

}  // namespace

EditableMesh::EditableMesh(const TriangleMesh& mesh, const MoveLimits& limits)
    : mesh_(Checked(mesh)),
      limits_(limits),
      cos_from_start_(CosineOfLimit(limits.max_turn_from_start)),
      cos_per_move_(CosineOfLimit(limits.max_turn_per_move)),
      mean_edge_(MeanEdge(mesh_)),
      tree_(mesh_) {
  LinkVerticesToFaces();
  for (std::size_t f = 0; f < mesh_.faces.size(); ++f) {
    shapes_.emplace_back(mesh_, f);
    start_normals_.push_back(shapes_.back().normal);
    start_heights_.push_back(Height(shapes_.back()));
  }
}

void EditableMesh::LinkVerticesToFaces() {
  face_begin_.assign(mesh_.vertices.size() + 1, 0);
  for (const auto& face : mesh_.faces) {
    for (const std::int32_t v : face) ++face_begin_[v + 1];
  }
  for (std::size_t v = 0; v < mesh_.vertices.size(); ++v) face_begin_[v + 1] += face_begin_[v];
  faces_of_.resize(3 * mesh_.faces.size());
  std::vector<std::int32_t> next(face_begin_.begin(), face_begin_.end() - 1);
  for (std::size_t f = 0; f < mesh_.faces.size(); ++f) {
    for (const std::int32_t v : mesh_.faces[f]) {
      faces_of_[next[v]++] = static_cast<std::int32_t>(f);
    }
  }
}

std::span<const std::int32_t> EditableMesh::FacesOf(std::int32_t vertex) const {
  return {faces_of_.data() + face_begin_[vertex], faces_of_.data() + face_begin_[vertex + 1]};
}

std::vector<std::int32_t> EditableMesh::FacesAround(std::span<const VertexMove> moves) const {
  std::vector<std::int32_t> faces;
  for (const VertexMove& move : moves) {
    const auto around = FacesOf(move.vertex);
    faces.insert(faces.end(), around.begin(), around.end());
  }
  std::sort(faces.begin(), faces.end());
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  return faces;
}

// Compares the places of the vertices now with the shapes, which are still the old ones.
MoveVerdict EditableMesh::CheckShapes(const std::vector<std::int32_t>& faces) const {
  for (const std::int32_t f : faces) {
    const FaceShape now(mesh_, f);
    const double least = std::min(limits_.min_height, 0.5 * start_heights_[f]);
    if (now.normal.isZero() || Height(now) < least) return MoveVerdict::kDegenerate;
    if (now.normal.dot(shapes_[f].normal) < cos_per_move_) return MoveVerdict::kInverted;
    if (now.normal.dot(start_normals_[f]) < cos_from_start_) return MoveVerdict::kTurned;
  }
  return MoveVerdict::kOk;
}

bool EditableMesh::Intersect(const std::vector<std::int32_t>& faces) const {
  for (const std::int32_t f : faces) {
    const bool found = tree_.AnyOverlap(tree_.BoxOf(f), [&](std::int32_t g) {
      if (g == f) return false;
      // Two changed faces need one look.
      if (g < f && std::binary_search(faces.begin(), faces.end(), g)) return false;
      return FacesIntersect(mesh_, f, g);
    });
    if (found) return true;
  }
  return false;
}

void EditableMesh::Refresh(const std::vector<std::int32_t>& faces) {
  for (const std::int32_t f : faces) {
    shapes_[f] = FaceShape(mesh_, f);
    tree_.Refit(mesh_, f);
  }
}

MoveVerdict EditableMesh::TryMove(std::span<const VertexMove> moves) {
  const std::vector<std::int32_t> faces = FacesAround(moves);
  const std::size_t kept = taken_back_to_.size();
  const auto put_back = [&] {
    for (; taken_back_to_.size() > kept; taken_back_to_.pop_back()) {
      Place(taken_back_to_.back().vertex, taken_back_to_.back().to);
    }
  };
  for (const VertexMove& move : moves) {
    const Vector3d to = InSinglePrecision(move.to);
    if (!to.allFinite()) {
      put_back();
      return MoveVerdict::kNotFinite;
    }
    taken_back_to_.push_back({move.vertex, Position(move.vertex)});
    Place(move.vertex, to);
  }
  const MoveVerdict verdict = CheckShapes(faces);
  if (verdict != MoveVerdict::kOk) {
    put_back();
    return verdict;
  }
  Refresh(faces);
  if (limits_.check_intersections && Intersect(faces)) {
    put_back();
    Refresh(faces);
    return MoveVerdict::kIntersects;
  }
  MergeSorted(faces, &changed_);
  return MoveVerdict::kOk;
}

MoveVerdict EditableMesh::TryMove(std::int32_t vertex, const Vector3d& to) {
  const VertexMove move{vertex, to};
  return TryMove(std::span(&move, 1));
}

void EditableMesh::Commit() {
  taken_back_to_.clear();
  changed_.clear();
}

void EditableMesh::Undo() {
  for (; !taken_back_to_.empty(); taken_back_to_.pop_back()) {
    Place(taken_back_to_.back().vertex, taken_back_to_.back().to);
  }
  Refresh(changed_);
  changed_.clear();
}

}  // namespace antigrasp
