#include "antigrasp/perturb/hold_descent.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "antigrasp/core/rng.h"
#include "antigrasp/perturb/perturbation.h"
#include "antigrasp/perturb/validity.h"
#include "antigrasp/quality/object_size.h"

namespace antigrasp {
namespace {

using Eigen::MatrixX3d;
using Eigen::Vector3d;

// Of Adam, as in search.cpp; the last step is a tenth of the first.
constexpr double kMomentum = 0.9, kSpreadMomentum = 0.97, kLeastSpread = 0.3, kLastStep = 0.1;
constexpr double kStartNoise = 0.5;  // of the vectors to begin with, percent of the diagonal
constexpr int kDescentDraws = 10, kNoisePool = 4000;
// A change that breaks the budget is tried again as this share of itself.
constexpr double kShares[] = {1.0, 0.95, 0.9, 0.8, 0.7, 0.6, 0.5, 0.4, 0.3, 0.2, 0.1};

// Of the field, percent of the diagonal.
double FieldRadius(const DescentOptions& options) {
  return options.radius > 0.0 ? options.radius
                              : std::clamp(5.0 + 1.4 * options.budget.hausdorff, 6.0, 12.0);
}

bool Inside(const TriangleMesh& mesh, const BoundingBox& box) {
  const BoundingBox bounds = Bounds(mesh);
  return (bounds.min.array() >= box.min.array()).all() &&
         (bounds.max.array() <= box.max.array()).all();
}

}  // namespace

HoldDescent::HoldDescent(const TriangleMesh& start, const MetricOptions& metric,
                         const DescentOptions& options, std::uint64_t seed)
    : start_(start),
      metric_(metric),
      options_(options),
      seed_(seed),
      keeper_(start, options.budget),
      field_(start, FieldRadius(options) / 100.0) {
  objective_.draws = kDescentDraws;
  RngStream noise(seed, "judged-noise");
  for (int i = 0; i < kNoisePool; ++i) pool_.push_back(DrawNoise(metric, &noise));
}

SmoothChange HoldDescent::Descend(std::uint64_t which) const {
  RngStream rng(seed_, "judged-start", which);
  MatrixX3d vectors(field_.centres(), 3);
  for (double& x : vectors.reshaped()) x = kStartNoise / options_.budget.hausdorff * rng.Normal();
  MatrixX3d mean = MatrixX3d::Zero(field_.centres(), 3), square = mean;
  for (int step = 0; step < options_.steps; ++step) {
    const MatrixX3d slope = Slope(field_.At(vectors), which, static_cast<std::uint64_t>(step));
    mean = kMomentum * mean + (1.0 - kMomentum) * slope;
    square = kSpreadMomentum * square + (1.0 - kSpreadMomentum) * slope.cwiseAbs2();
    const MatrixX3d spread = (square / (1.0 - std::pow(kSpreadMomentum, step + 1))).cwiseSqrt();
    const double least = kLeastSpread * spread.mean();
    if (!(least > 0.0)) continue;  // no grasp is left
    const double length = options_.first_step / options_.budget.hausdorff /
                          (1.0 - std::pow(kMomentum, step + 1)) *
                          std::pow(kLastStep, double(step) / options_.steps);
    vectors -= length * (mean.array() / (spread.array() + least)).matrix();
  }
  return Kept(field_.At(vectors));
}

SmoothChange HoldDescent::Kept(const MatrixX3d& moves) const {
  for (const double share : kShares) {
    TriangleMesh mesh = InSinglePrecision(MovedBy(moves, keeper_.longest_move(), share, start_));
    if (keeper_.Broken(mesh).empty()) return {share * moves, std::move(mesh)};
  }
  return {0.0 * moves, start_};
}

// Of the objective by the field's vectors.
MatrixX3d HoldDescent::Slope(const MatrixX3d& moves, std::uint64_t which,
                             std::uint64_t step) const {
  const TriangleMesh mesh = MovedBy(moves, keeper_.longest_move(), 1.0, start_);
  const double scale = MetresPerUnit(metric_, Bounds(mesh).Extent());
  const TriangleMesh metres = Transformed(mesh, scale, Vector3d::Zero());
  const std::vector<Vector3d> normals = FaceNormals(mesh);
  const std::uint64_t seed = RngStream(seed_, "judged-grasps", which).NextU64();
  MeanHold hold =
      EvaluateMeanHold(SampleAttackGrasps(metres, metric_, objective_, pool_, seed, step), normals,
                       metric_, objective_);
  std::vector<Vector3d> by_vertex(mesh.vertices.size(), Vector3d::Zero());
  keeper_.AddPenalty(mesh, normals, &hold.by_normal, &by_vertex);
  const std::vector<Vector3d> by_turn = DerivativeByVertices(mesh, hold.by_normal);
  for (std::size_t v = 0; v < by_vertex.size(); ++v) by_vertex[v] += by_turn[v];
  return field_.Back(ByMoves(moves, keeper_.longest_move(), by_vertex));
}

TriangleMesh RefinedSolid(const TriangleMesh& mesh, const MetricOptions& metric,
                          const DescentOptions& options, const BoundingBox& within,
                          std::uint64_t seed) {
  PerturbResult begun;
  if (!BeginPerturbation(mesh, &begun)) return mesh;
  const HoldDescent descent(begun.start, metric, options, seed);
  SmoothChange whole = descent.Descend(0);
  if (Inside(whole.mesh, within)) return std::move(whole.mesh);
  for (const double share : {0.75, 0.5, 0.25}) {
    SmoothChange part = descent.Kept(share * whole.moves);
    if (Inside(part.mesh, within)) return std::move(part.mesh);
  }
  return mesh;
}

}  // namespace antigrasp
