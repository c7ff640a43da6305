#include "antigrasp/perturb/change_budget.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "antigrasp/core/angles.h"
#include "antigrasp/datasets/roughness.h"
#include "antigrasp/mesh/topology.h"
#include "antigrasp/perturb/search_objective.h"
#include "antigrasp/perturb/search_projection.h"
#include "antigrasp/perturb/validity.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

// What is reported is computed by other formulas on the same mesh: room for their rounding.
constexpr double kInside = 1.0 - 1e-6;
// Penalties begin at this share of a limit, so that a descent ends within it.
constexpr double kSoftTurn = 0.85, kSoftVolume = 0.9, kSoftRoughness = 0.85;
// Weights against an objective between 0 and 1: a mesh that breaks a limit all over costs more than
// any grasp.
constexpr double kTurnWeight = 100.0, kVolumeWeight = 0.04, kRoughnessWeight = 40.0;
// Flat edges have no slope of their angle.
constexpr double kLeastSine = 0.05;

}  // namespace

void Bind(OptionTable* table, ChangeBudget* budget) {
  ChangeBudget& b = *budget;
  table->Add("search.hausdorff", &b.hausdorff, 0.01, 50.0,
             "budget: how far the surface moves, percent of the bounding-box diagonal");
  table->Add("search.volume", &b.volume, 0.0, 90.0,
             "budget: change of volume, percent, either way");
  table->Add("search.turn", &b.turn, 0.1, 90.0, "budget: largest turn of a normal, degrees");
  table->Add("search.roughness", &b.roughness, 0.0, 1e3,
             "budget: rise of the mean dihedral angle, percent of the original's");
}

BudgetKeeper::BudgetKeeper(const TriangleMesh& start, const ChangeBudget& budget)
    : start_(start),
      budget_(budget),
      start_normals_(FaceNormals(start)),
      longest_move_(0.999 * budget.hausdorff / 100.0 * Bounds(start).Extent().norm()),
      volume_(Volume(start)),
      roughness_(MeanDihedralAngle(start)) {
  const std::vector<EdgeUse> uses = SortedEdgeUses(start);
  ForEachEdge(uses, [&](auto first, auto last) {
    if (last - first != 2) return;
    edges_.push_back(
        {static_cast<std::size_t>(first->low),
         static_cast<std::size_t>(first->high),
         {static_cast<std::size_t>(first->face), static_cast<std::size_t>((first + 1)->face)}});
  });
}

std::string BudgetKeeper::Broken(const TriangleMesh& mesh) const {
  const double most = 1.0005 * longest_move_;  // still below the limit
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    if (!((mesh.vertices[v] - start_.vertices[v]).norm() <= most)) return "moved too far";
  }
  if (100.0 * std::abs(Volume(mesh) / volume_ - 1.0) > kInside * budget_.volume) return "volume";
  if (LargestTurn(mesh, start_normals_) > kInside * budget_.turn * kDegree) return "turned";
  if (MeanDihedralAngle(mesh) > (1.0 + budget_.roughness / 100.0) * roughness_) return "roughness";
  return WhyNotPrintable(mesh);
}

void BudgetKeeper::AddTurn(const std::vector<Vector3d>& normals,
                           std::vector<Vector3d>* by_normal) const {
  const double limit = std::cos(kSoftTurn * budget_.turn * kDegree);
  const double weight = kTurnWeight / static_cast<double>(normals.size());
  for (std::size_t f = 0; f < normals.size(); ++f) {
    const double beyond = limit - normals[f].dot(start_normals_[f]);
    if (beyond > 0.0) (*by_normal)[f] -= 2.0 * weight * beyond * start_normals_[f];
  }
}

void BudgetKeeper::AddRoughness(const TriangleMesh& mesh, const std::vector<Vector3d>& normals,
                                std::vector<Vector3d>* by_normal) const {
  double weighted = 0.0, length = 0.0;
  std::vector<std::pair<double, double>> edges;  // length, sine
  edges.reserve(edges_.size());
  for (const Edge& edge : edges_) {
    const Vector3d &u = normals[edge.faces.first], &v = normals[edge.faces.second];
    edges.emplace_back((mesh.vertices[edge.high] - mesh.vertices[edge.low]).norm(),
                       u.cross(v).norm());
    weighted += edges.back().first * std::atan2(edges.back().second, u.dot(v));
    length += edges.back().first;
  }
  // The mean angle in shares of the original's.
  const double original = roughness_ * kDegree;
  if (!(length > 0.0) || !(original > 0.0)) return;
  const double beyond =
      weighted / length / original - 1.0 - kSoftRoughness * budget_.roughness / 100.0;
  if (!(beyond > 0.0)) return;
  for (std::size_t e = 0; e < edges_.size(); ++e) {
    const auto [f, g] = edges_[e].faces;
    // d angle / d u = -v / sine
    const double slope = 2.0 * kRoughnessWeight * beyond * edges[e].first / length / original /
                         std::max(kLeastSine, edges[e].second);
    (*by_normal)[f] -= slope * normals[g];
    (*by_normal)[g] -= slope * normals[f];
  }
}

void BudgetKeeper::AddVolume(const TriangleMesh& mesh, std::vector<Vector3d>* by_vertex) const {
  const double change = 100.0 * (Volume(mesh) / volume_ - 1.0);
  const double beyond = std::abs(change) - kSoftVolume * budget_.volume;
  if (!(beyond > 0.0)) return;
  const double slope = std::copysign(2.0 * kVolumeWeight * beyond * 100.0 / volume_, change);
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    // A corner's part of the volume's derivative, up to what cancels over a closed surface.
    const Vector3d part = slope / 6.0 * FaceCross(mesh, f);
    for (const std::int32_t v : mesh.faces[f]) (*by_vertex)[static_cast<std::size_t>(v)] += part;
  }
}

void BudgetKeeper::AddPenalty(const TriangleMesh& mesh, const std::vector<Vector3d>& normals,
                              std::vector<Vector3d>* by_normal,
                              std::vector<Vector3d>* by_vertex) const {
  AddTurn(normals, by_normal);
  AddRoughness(mesh, normals, by_normal);
  AddVolume(mesh, by_vertex);
}

}  // namespace antigrasp
