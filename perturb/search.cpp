#include "antigrasp/perturb/search.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "antigrasp/core/angles.h"
#include "antigrasp/perturb/search_projection.h"
#include "antigrasp/perturb/validity.h"
#include "antigrasp/quality/graspability.h"
#include "antigrasp/quality/object_size.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

constexpr int kSweepsToFinish = 300;
// Adam (Kingma and Ba 2015), its usual constants but for a shorter memory of the spread.
constexpr double kMomentum = 0.9, kSpreadMomentum = 0.99;
// Vertices whose derivative is far below the mesh's mean take smaller steps.
constexpr double kLeastSpread = 0.1;
// Turning faces back moves vertices too: room for it.
constexpr double kInsideMaxMove = 0.95;

std::vector<Vector3d> VertexNormals(const TriangleMesh& mesh) {
  std::vector<Vector3d> normals(mesh.vertices.size(), Vector3d::Zero());
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    for (const std::int32_t v : mesh.faces[f]) {
      normals[static_cast<std::size_t>(v)] += FaceCross(mesh, f);
    }
  }
  for (Vector3d& normal : normals) normal.normalize();
  return normals;
}

std::vector<double> FaceHeights(const TriangleMesh& mesh) {
  std::vector<double> heights;
  for (const auto& face : mesh.faces) {
    std::array<Vector3d, 3> corner;
    for (std::size_t k = 0; k < 3; ++k) {
      corner[k] = mesh.vertices[static_cast<std::size_t>(face[k])];
    }
    heights.push_back(FaceHeight(corner[0], corner[1], corner[2]));
  }
  return heights;
}

// Adam on one number per vertex.
class Adam {
 public:
  explicit Adam(std::size_t count) : mean_(count, 0.0), square_(count, 0.0) {}

  // The change for this derivative, at most about 1 in size, downhill.
  std::vector<double> Step(const std::vector<double>& derivative) {
    ++steps_;
    const double bias = 1.0 - std::pow(kMomentum, steps_);
    const double square_bias = 1.0 - std::pow(kSpreadMomentum, steps_);
    double spread = 0.0;
    for (std::size_t i = 0; i < mean_.size(); ++i) {
      mean_[i] += (1.0 - kMomentum) * (derivative[i] - mean_[i]);
      square_[i] += (1.0 - kSpreadMomentum) * (derivative[i] * derivative[i] - square_[i]);
      spread += std::sqrt(square_[i] / square_bias) / static_cast<double>(mean_.size());
    }
    std::vector<double> change(mean_.size(), 0.0);
    if (!(spread > 0.0)) return change;
    for (std::size_t i = 0; i < mean_.size(); ++i) {
      change[i] =
          -(mean_[i] / bias) / (std::sqrt(square_[i] / square_bias) + kLeastSpread * spread);
    }
    return change;
  }

 private:
  int steps_ = 0;
  std::vector<double> mean_, square_;
};

class SearchRun {
 public:
  SearchRun(const TriangleMesh& start, const MetricOptions& metric, const SearchOptions& options,
            RngStream* rng)
      : start_(start),
        metric_(metric),
        options_(options),
        seed_(rng->NextU64()),
        box_(Bounds(start)),
        start_normals_(FaceNormals(start)),
        vertex_normals_(VertexNormals(start)),
        start_heights_(FaceHeights(start)),
        mean_edge_(MeanEdge(start)),
        adam_(start.vertices.size()),
        work_(start) {
    RngStream noise(seed_, "search-noise");
    for (int i = 0; i < options.objective.noise_pool; ++i) {
      pool_.push_back(DrawNoise(metric, &noise));
    }
    for (std::size_t v = 0; v < work_.vertices.size(); ++v) {
      Raise(v, options.start_noise * noise.Normal());
    }
    Constrain();
  }

  void Step(int step) {
    const double scale = MetresPerUnit(metric_, Bounds(work_).Extent());
    const TriangleMesh metres = Transformed(work_, scale, Vector3d::Zero());
    const auto grasps = SampleAttackGrasps(metres, metric_, options_.objective, pool_, seed_,
                                           static_cast<std::uint64_t>(step));
    const SmoothPercentile objective =
        EvaluateObjective(grasps, FaceNormals(metres), metric_, options_.objective);
    const auto by_vertex = DerivativeByVertices(metres, objective.by_normal);
    std::vector<double> by_height(by_vertex.size());
    for (std::size_t v = 0; v < by_vertex.size(); ++v) {
      by_height[v] = vertex_normals_[v].dot(by_vertex[v]);
    }
    Smooth(Coarseness(step), &by_height);
    const double length =
        options_.step * std::pow(options_.last_step, double(step) / options_.steps);
    const auto change = adam_.Step(by_height);
    for (std::size_t v = 0; v < change.size(); ++v) Raise(v, length * change[v]);
    Constrain();
  }

  // The state as a printable mesh that keeps every limit. Where the projection does not end in one,
  // part of the way back to the original.
  std::optional<TriangleMesh> Finished() const {
    for (const double share : {1.0, 0.9, 0.7, 0.4}) {
      for (const double margin : {1e-3, 1e-2}) {
        TriangleMesh mesh = work_;
        for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
          mesh.vertices[v] = start_.vertices[v] + share * (work_.vertices[v] - start_.vertices[v]);
        }
        if (TurnBack(start_, start_normals_, (1.0 - margin) * Alpha(), kSweepsToFinish, &mesh) > 0)
          continue;
        mesh = InSinglePrecision(mesh);
        if (KeepsLimits(mesh)) return mesh;
      }
    }
    return std::nullopt;
  }

  double Score(const TriangleMesh& mesh) const {
    double sum = 0.0;
    for (int i = 0; i < options_.scoring_rounds; ++i) {
      sum += EvaluateGraspability(mesh, metric_, seed_, static_cast<std::uint64_t>(i)).value;
    }
    return sum;
  }

 private:
  double Alpha() const { return options_.alpha * kDegree; }

  // Passes of smoothing in this step: options.coarse at first, none from half way on.
  int Coarseness(int step) const {
    return static_cast<int>(options_.coarse * std::max(0.0, 1.0 - 2.0 * step / options_.steps));
  }

  // Every vertex takes the mean of its neighbours' values, its own weighs a third of theirs.
  void Smooth(int passes, std::vector<double>* values) const {
    std::vector<double> sum(values->size());
    for (int pass = 0; pass < passes; ++pass) {
      std::fill(sum.begin(), sum.end(), 0.0);
      std::vector<double> weight(values->size(), 0.0);
      for (const auto& face : start_.faces) {
        for (std::size_t k = 0; k < 3; ++k) {
          const auto v = static_cast<std::size_t>(face[k]);
          sum[v] += (*values)[static_cast<std::size_t>(face[(k + 1) % 3])] + (*values)[v] / 3.0;
          weight[v] += 4.0 / 3.0;
        }
      }
      for (std::size_t v = 0; v < sum.size(); ++v) (*values)[v] = sum[v] / weight[v];
    }
  }

  // By mean edge lengths.
  void Raise(std::size_t vertex, double height) {
    work_.vertices[vertex] += height * mean_edge_ * vertex_normals_[vertex];
  }

  double MaxMove() const { return options_.max_move / 100.0 * box_.Extent().norm(); }

  void Constrain() {
    if (options_.keep_extents) {
      for (Vector3d& v : work_.vertices) v = v.cwiseMax(box_.min).cwiseMin(box_.max);
    }
    for (std::size_t v = 0; v < work_.vertices.size(); ++v) {
      const Vector3d move = work_.vertices[v] - start_.vertices[v];
      const double most = kInsideMaxMove * MaxMove();
      if (move.squaredNorm() > most * most) {
        work_.vertices[v] = start_.vertices[v] + most * move.normalized();
      }
    }
    TurnBack(start_, start_normals_, Alpha(), options_.sweeps, &work_);
  }

  double LargestMove(const TriangleMesh& mesh) const {
    double squared = 0.0;
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
      squared = std::max(squared, (mesh.vertices[v] - start_.vertices[v]).squaredNorm());
    }
    return std::sqrt(squared);
  }

  bool KeepsLimits(const TriangleMesh& mesh) const {
    if (LargestTurn(mesh, start_normals_) > Alpha() || LargestMove(mesh) > MaxMove()) return false;
    const double least = MoveLimits().min_height;
    const std::vector<double> heights = FaceHeights(mesh);
    for (std::size_t f = 0; f < heights.size(); ++f) {
      if (heights[f] < std::min(least, 0.5 * start_heights_[f])) return false;
    }
    return WhyNotPrintable(mesh).empty();
  }

  const TriangleMesh& start_;
  const MetricOptions& metric_;
  const SearchOptions& options_;
  std::uint64_t seed_;
  BoundingBox box_;
  std::vector<Vector3d> start_normals_, vertex_normals_;
  std::vector<double> start_heights_;
  double mean_edge_;
  std::vector<NoiseDraw> pool_;
  Adam adam_;
  TriangleMesh work_;
};

// Whether the state after `step` of `steps` is scored: evenly over the second half, the last one
// always.
bool IsCandidate(int step, const SearchOptions& options) {
  const int left = options.steps - step;
  const auto mark = [&](int at) {
    return (static_cast<std::int64_t>(at) * 2 * options.candidates) / options.steps;
  };
  return left == 0 || (2 * left < options.steps && mark(left) != mark(left - 1));
}

}  // namespace

void Bind(OptionTable* table, SearchOptions* options) {
  SearchOptions& o = *options;
  table->Add("search.alpha", &o.alpha, 0.0, 60.0,
             "largest deviation of a face normal from the original's, degrees");
  table->Add("search.steps", &o.steps, 1, 1e6, "steps of the descent");
  table->Add("search.step", &o.step, 1e-6, 10.0, "first step of a vertex, mean edge lengths");
  table->Add("search.last_step", &o.last_step, 1e-6, 1.0, "last step as a share of the first");
  table->Add("search.start_noise", &o.start_noise, 0.0, 1.0,
             "random heights to begin with, mean edge lengths");
  table->Add("search.coarse", &o.coarse, 0, 1e6,
             "passes that smooth the first derivative over neighbours, falling to none half way: "
             "long dents first");
  table->Add("search.sweeps", &o.sweeps, 1, 10000,
             "sweeps that turn faces back into their cones after each step");
  table->Add("search.keep_extents", &o.keep_extents,
             "keep the vertices in the original's bounding box");
  table->Add("search.max_move", &o.max_move, 1e-3, 1e3,
             "largest move of a vertex, percent of the bounding-box diagonal");
  table->Add("search.candidates", &o.candidates, 1, 1000,
             "states of the second half that are scored; the best is taken");
  table->Add("search.scoring_rounds", &o.scoring_rounds, 1, 1000, "grasp sets that score a state");
  ObjectiveOptions& b = o.objective;
  table->Add("search.grasps", &b.grasps, 1, 1e6, "fresh grasps in each step");
  table->Add("search.draws", &b.draws, 1, 1e5, "noise draws per grasp in each step");
  table->Add("search.noise_pool", &b.noise_pool, 1, 1e7,
             "noise draws per object, from which all steps take theirs");
  table->Add("search.cone_width", &b.cone_width, 0.0, 10.0,
             "grasps are sampled this far beyond the friction cone, tangents");
  table->Add("search.acceptance_softness", &b.acceptance_softness, 1e-4, 10.0,
             "softness of the cone's rim for planned grasps, tangents");
  table->Add("search.slip_softness", &b.slip_softness, 1e-4, 10.0,
             "softness of slipping beside the spread of friction, tangents");
  table->Add("search.percentile_softness", &b.percentile_softness, 1e-3, 10.0,
             "kernel about the percentile, as a share of it");
}

PerturbResult PerturbBySearch(const TriangleMesh& mesh, const MetricOptions& metric,
                              const SearchOptions& options, RngStream* rng,
                              const ProgressFn& progress) {
  PerturbResult result;
  if (!BeginPerturbation(mesh, &result)) return result;
  result.mesh = result.start;
  if (!(options.alpha > 0.0)) return result;
  SearchRun run(result.start, metric, options, rng);
  double best = run.Score(result.start);
  for (int step = 0; step < options.steps; ++step) {
    run.Step(step);
    ++result.iterations;
    if (IsCandidate(step + 1, options)) {
      if (const auto candidate = run.Finished()) {
        const double score = run.Score(*candidate);
        if (score < best) {
          best = score;
          result.mesh = *candidate;
          result.moved = result.iterations;
        } else {
          ++result.no_gain;
        }
      }
    }
    if (progress) progress(step + 1, options.steps);
  }
  return result;
}

}  // namespace antigrasp
