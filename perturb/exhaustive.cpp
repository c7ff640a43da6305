#include "antigrasp/perturb/exhaustive.h"

#include <algorithm>
#include <cmath>

#include "antigrasp/perturb/draw_direction.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

// The faces that are antipodal to each face.
std::vector<std::vector<std::int32_t>> PartnersOf(const std::vector<FacePair>& pairs,
                                                  std::int32_t num_faces) {
  std::vector<std::vector<std::int32_t>> partners(static_cast<std::size_t>(num_faces));
  for (const FacePair& pair : pairs) {
    partners[pair.first].push_back(pair.second);
    partners[pair.second].push_back(pair.first);
  }
  return partners;
}

class ExhaustiveRun {
 public:
  ExhaustiveRun(const PairLimits& pairs, const ExhaustiveOptions& options, EditableMesh* mesh,
                RngStream* rng, PerturbResult* result)
      : pairs_(pairs),
        options_(options),
        mesh_(*mesh),
        rng_(*rng),
        result_(*result),
        delta_(options.step / 100.0 * Bounds(mesh->mesh()).Extent().norm()) {}

  // F_a of the mesh as it is, and how many of its pairs are below the cone.
  PairCount Look(std::int64_t iteration) {
    const auto pairs = AntipodalPairs(mesh_.mesh(), pairs_);
    PairCount count{iteration, static_cast<std::int64_t>(pairs.size()), 0};
    for (const FacePair& pair : pairs) {
      const double phi = AntipodalityAngle(mesh_.Normal(pair.first), mesh_.Normal(pair.second));
      if (phi < pairs_.cone_angle) ++count.below;
    }
    partners_ = PartnersOf(pairs, mesh_.num_faces());
    return count;
  }

  void Iterate() {
    bool moved = false;
    for (std::int32_t v = 0; v < mesh_.num_vertices(); ++v) {
      const auto around = mesh_.FacesOf(v);
      const bool in_pair = std::any_of(around.begin(), around.end(),
                                       [&](std::int32_t f) { return !partners_[f].empty(); });
      if (in_pair) moved |= MoveVertex(v);
    }
    moved ? ++result_.moved : ++result_.no_gain;
  }

 private:
  struct Place {
    Vector3d at;
    double sum;
  };

  bool MoveVertex(std::int32_t vertex) {
    std::vector<Place> places;
    for (int i = 0; i < options_.directions; ++i) {
      const Vector3d at = mesh_.Position(vertex) + delta_ * DrawDirection(&rng_);
      places.push_back({at, AngleSum(vertex, at)});
    }
    const double now = AngleSum(vertex, mesh_.Position(vertex));
    std::stable_sort(places.begin(), places.end(),
                     [](const Place& a, const Place& b) { return a.sum > b.sum; });
    for (const Place& place : places) {
      if (options_.only_if_better && !(place.sum > now)) return false;
      const MoveVerdict verdict = mesh_.TryMove(vertex, place.at);
      if (verdict == MoveVerdict::kOk) {
        mesh_.Commit();
        return true;
      }
      ++result_.refused[static_cast<std::size_t>(verdict)];
    }
    return false;
  }

  // The sum over the pairs of F_a with a face around the vertex, were it at `at`.
  double AngleSum(std::int32_t vertex, const Vector3d& at) const {
    const auto around = mesh_.FacesOf(vertex);
    const auto& faces = mesh_.mesh().faces;
    std::vector<Vector3d> normals;
    for (const std::int32_t f : around) {
      const auto place = [&](int k) {
        return faces[f][k] == vertex ? at : mesh_.Position(faces[f][k]);
      };
      normals.push_back(FaceShape(place(0), place(1), place(2)).normal);
    }
    double sum = 0.0;
    for (std::size_t i = 0; i < around.size(); ++i) {
      for (const std::int32_t partner : partners_[around[i]]) {
        const auto also = std::find(around.begin(), around.end(), partner);
        if (also == around.end()) {
          sum += AntipodalityAngle(normals[i], mesh_.Normal(partner));
        } else if (around[i] < partner) {  // both faces hold the vertex: one pair, met twice
          sum += AntipodalityAngle(normals[i], normals[also - around.begin()]);
        }
      }
    }
    return sum;
  }

  const PairLimits& pairs_;
  const ExhaustiveOptions& options_;
  EditableMesh& mesh_;
  RngStream& rng_;
  PerturbResult& result_;
  double delta_;
  std::vector<std::vector<std::int32_t>> partners_;
};

}  // namespace

void Bind(OptionTable* table, ExhaustiveOptions* options) {
  ExhaustiveOptions& o = *options;
  table->Add("exhaustive.iterations", &o.iterations, 0, 1e9, "iterations (paper: 64)");
  table->Add("exhaustive.step", &o.step, 1e-6, 100.0,
             "length of every step, percent of the bounding-box diagonal");
  table->Add("exhaustive.directions", &o.directions, 1, 1000,
             "random directions tried for a vertex");
  table->Add("exhaustive.only_if_better", &o.only_if_better,
             "leave a vertex where it is when no direction raises the sum of angles");
}

PerturbResult PerturbExhaustively(const TriangleMesh& mesh, const PairLimits& pairs,
                                  const PerturbOptions& common, const ExhaustiveOptions& options,
                                  RngStream* rng, const ProgressFn& progress) {
  PerturbResult result;
  if (!BeginPerturbation(mesh, &result)) return result;
  EditableMesh work(result.start, GuardLimits(common));
  ExhaustiveRun run(pairs, options, &work, rng, &result);
  for (;;) {
    const PairCount count = run.Look(result.iterations);
    if (common.history) result.history.push_back(count);
    result.no_pairs_left = count.below == 0;
    if (result.no_pairs_left || result.iterations >= options.iterations) break;
    run.Iterate();
    ++result.iterations;
    if (progress) progress(result.iterations, options.iterations);
  }
  EndPerturbation(work, &result);
  return result;
}

}  // namespace antigrasp
