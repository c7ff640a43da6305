#include <cstdio>
#include <string>

#include "antigrasp/quality/antipodal_sampler.h"
#include "antigrasp/quality/epsilon.h"
#include "antigrasp/quality/graspability.h"
#include "antigrasp/quality/jaw_closing.h"
#include "antigrasp/quality/reachability.h"
#include "antigrasp/quality/robust_quality.h"
#include "bench/bench_objects.h"
#include "bench/compare.h"
#include "bench/peer_evaluation.h"
#include "bench/timing.h"

namespace antigrasp::bench {
namespace {

constexpr int kObjects = 20;
constexpr int kRounds = 5;

// What one evaluation works on, recorded so that each step can be repeated alone.
struct Recorded {
  TriangleMesh mesh;  // metres
  Eigen::Vector3d com;
  Graspability score;
  std::vector<NoiseDraw> noise;
  std::vector<JawPose> poses;
  std::vector<std::array<Contact, 2>> contacts;  // of the draws whose jaws close
  std::vector<double> friction;
};

Recorded Record(const TriangleMesh& unit_mesh, const MetricOptions& options) {
  Recorded r;
  r.mesh = InMetres(unit_mesh);
  r.com = CenterOfMass(r.mesh);
  r.score = EvaluateGraspability(unit_mesh, options, 1, 0);
  const RayScene scene(r.mesh);
  for (std::size_t g = 0; g < r.score.grasps.size(); ++g) {
    RngStream rng(1, "noise", 0, g);
    for (int draw = 0; draw < options.num_draws; ++draw) {
      r.noise.push_back(DrawNoise(options, &rng));
      r.poses.push_back(ExecutedPose(r.score.grasps[g].grasp, r.com, r.noise.back()));
      const auto contacts = CloseJaws(scene, r.poses.back().center, r.poses.back().axis,
                                      options.jaw_opening, r.noise.back().friction);
      if (!contacts) continue;
      r.contacts.push_back(*contacts);
      r.friction.push_back(r.noise.back().friction);
    }
  }
  return r;
}

// The steps of one evaluation, each over all recorded objects.
struct Steps {
  const std::vector<Recorded>& objects;
  const MetricOptions& options;
  double* sink;

  void BuildScenes() const {
    for (const Recorded& r : objects) {
      const RayScene scene(r.mesh);
      *sink += scene.Blocks().radius();
    }
  }
  void DrawNoises() const {
    std::vector<NoiseDraw> draws(static_cast<std::size_t>(options.num_draws));
    for (const Recorded& r : objects) {
      RngStream rng(1, "noise", 0, 0);
      for (std::size_t i = 0; i < r.noise.size(); i += draws.size()) {
        antigrasp::DrawNoises(options, &rng, draws);
        *sink += draws[0].friction;
      }
    }
  }
  // A grasp's draws together, as they are recorded.
  void CastRays(const std::vector<RayScene>& scenes) const {
    const auto draws = static_cast<std::size_t>(options.num_draws);
    std::vector<JawClosing> closings(draws);
    std::vector<std::optional<std::array<Contact, 2>>> contacts(draws);
    for (std::size_t k = 0; k < objects.size(); ++k) {
      const Recorded& r = objects[k];
      for (std::size_t first = 0; first < r.poses.size(); first += draws) {
        for (std::size_t i = 0; i < draws; ++i) {
          const JawPose& pose = r.poses[first + i];
          closings[i] = {pose.center, pose.axis, r.noise[first + i].friction};
        }
        CloseJawsTogether(scenes[k], closings, options.jaw_opening, contacts);
        *sink += contacts[0].has_value();
      }
    }
  }
  void Epsilons() const {
    for (const Recorded& r : objects) {
      for (std::size_t i = 0; i < r.contacts.size(); ++i) {
        *sink += Epsilon(r.contacts[i], r.com, WrenchModelOf(options, r.friction[i]));
      }
    }
  }
  void Sample(const std::vector<RayScene>& scenes) const {
    for (std::size_t k = 0; k < objects.size(); ++k) {
      const Recorded& r = objects[k];
      const AntipodalSampler sampler(r.mesh, scenes[k], options.friction, options.jaw_opening);
      for (int i = 0; i < r.score.attempts; ++i) {
        RngStream rng(1, "grasp", 0, static_cast<std::uint64_t>(i));
        *sink += sampler.Try(&rng).has_value();
      }
    }
  }
  void Reach(const std::vector<RayScene>& scenes) const {
    for (std::size_t k = 0; k < objects.size(); ++k) {
      const GripperCollision gripper(objects[k].mesh, scenes[k], options.gripper);
      for (const ScoredGrasp& scored : objects[k].score.grasps) {
        *sink += gripper.FreeApproach(scored.grasp, options.jaw_opening).has_value();
      }
    }
  }
};

void PrintShares(const std::vector<TriangleMesh>& meshes, const MetricOptions& options,
                 double* sink) {
  std::vector<Recorded> objects;
  for (int i = 0; i < kObjects; ++i) {
    objects.push_back(Record(meshes[static_cast<std::size_t>(i)], options));
  }
  std::vector<RayScene> scenes;
  for (const Recorded& r : objects) scenes.emplace_back(r.mesh);
  const Steps steps{objects, options, sink};
  const std::vector<Contender> contenders{
      {"object",
       [&] {
         for (int i = 0; i < kObjects; ++i) {
           const auto slot = static_cast<std::size_t>(i);
           *sink += EvaluateGraspability(meshes[slot], options, 1, 0).value;
         }
       },
       kObjects},
      {"ray_tree", [&] { steps.BuildScenes(); }, kObjects},
      {"rays", [&] { steps.CastRays(scenes); }, kObjects},
      {"sampling", [&] { steps.Sample(scenes); }, kObjects},
      {"gripper", [&] { steps.Reach(scenes); }, kObjects},
      {"noise", [&] { steps.DrawNoises(); }, kObjects},
      {"epsilon", [&] { steps.Epsilons(); }, kObjects}};
  const std::vector<double> seconds = MedianSeconds(contenders, kRounds);
  for (std::size_t i = 0; i < seconds.size(); ++i) PrintTime(contenders[i].name, seconds[i]);
  double rest = seconds[0];
  for (std::size_t i = 1; i < seconds.size(); ++i) {
    std::printf("share %s %.0f %%\n", contenders[i].name.c_str(), 100 * seconds[i] / seconds[0]);
    rest -= seconds[i];
  }
  std::printf("share rest %.0f %%\n", 100 * rest / seconds[0]);
  std::printf("limit object_vs_its_rays %.2f (1 = nothing but the tree and the rays)\n",
              seconds[0] / (seconds[1] + seconds[2]));
}

// Mesh i is object i.
std::vector<Graspability> ScoreEach(const std::vector<TriangleMesh>& meshes,
                                    const MetricOptions& options, int threads) {
  return ScoreAll(
      std::ssize(meshes), [&](std::int64_t i) { return &meshes[static_cast<std::size_t>(i)]; },
      [](std::int64_t i) { return static_cast<std::uint64_t>(i); }, options, 1, threads);
}

// Adaptive draws: the time saved, and how far the answers are from full sampling's.
void CompareAdaptive(const std::vector<TriangleMesh>& meshes, const MetricOptions& full,
                     double* sink) {
  MetricOptions adaptive = full;
  adaptive.adaptive = true;
  const auto run = [&](const MetricOptions& options) {
    return [&] { *sink += ScoreEach(meshes, options, 1).front().value; };
  };
  const std::vector<double> seconds =
      MedianSeconds({{"full", run(full)}, {"adaptive", run(adaptive)}}, 3);
  PrintRatio("adaptive_draws_vs_full", seconds[0] / seconds[1]);
  const auto a = ScoreEach(meshes, full, 0), b = ScoreEach(meshes, adaptive, 0);
  int inside = 0, equal = 0;
  double draws = 0.0, all = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    inside += b[i].value >= a[i].ci_low && b[i].value <= a[i].ci_high;
    equal += b[i].value == a[i].value;
    for (const ScoredGrasp& grasp : b[i].grasps) draws += grasp.draws;
    all += static_cast<double>(b[i].grasps.size()) * full.num_draws;
  }
  std::printf("adaptive: %.0f %% of the draws; %d of %zu values equal, %d within the interval\n",
              100 * draws / all, equal, a.size(), inside);
}

// The settled metric beside graspability, an object of the set a call, one thread.
void CompareSettled(const std::vector<TriangleMesh>& meshes, const MetricOptions& options,
                    double* sink) {
  const auto run = [&](const MetricOptions& metric) {
    return [&meshes, &metric, sink] { *sink += ScoreEach(meshes, metric, 1).front().value; };
  };
  MetricOptions settled = options, balls = options;
  JudgeSettled(&settled);
  balls.contact = TipContact::kSphere;
  const std::vector<double> seconds = MedianSeconds(
      {{"graspability", run(options)}, {"settled", run(settled)}, {"balls", run(balls)}}, 3);
  const double each = 1e3 / static_cast<double>(meshes.size());
  std::printf(
      "time object_graspability %.2f ms, settled %.2f ms, balls at first contacts %.2f ms\n",
      each * seconds[0], each * seconds[1], each * seconds[2]);
  std::printf("limit settled_vs_graspability %.2f (of its cost)\n", seconds[1] / seconds[0]);
}

void ComparePeer(const TriangleMesh& unit_mesh, const MetricOptions& options, double* sink) {
  const Recorded r = Record(unit_mesh, options);
  const auto ours = [&] {
    const RayScene scene(r.mesh);
    const Eigen::Vector3d com = CenterOfMass(r.mesh);
    for (std::size_t g = 0; g < r.score.grasps.size(); ++g) {
      RngStream rng(1, "noise", 0, g);
      *sink += RobustQuality(scene, com, r.score.grasps[g].grasp, options, &rng);
    }
  };
  const auto peer = [&] {
    for (const double quality : PeerQualities(r.mesh, r.score.grasps, options)) *sink += quality;
  };
  const std::vector<double> seconds = MedianSeconds({{"ours", ours}, {"qhull_cgal", peer}}, 3);
  PrintTime("object_qhull_cgal", seconds[1]);
  PrintRatio("robust_quality_vs_qhull_and_cgal", seconds[1] / seconds[0]);
}

void CompareRays(const TriangleMesh& unit_mesh, const MetricOptions& options, double* sink) {
  const Recorded r = Record(unit_mesh, options);
  const RayScene embree(r.mesh);
  const CgalRays cgal(r.mesh);
  const auto cast = [&](const auto& rays) {
    for (const JawPose& pose : r.poses) {
      const Eigen::Vector3d from = pose.center - 0.5 * options.jaw_opening * pose.axis;
      *sink += rays.Closest(from, pose.axis, options.jaw_opening).has_value();
    }
  };
  const double count = static_cast<double>(r.poses.size());
  const std::vector<double> seconds =
      MedianSeconds({{"ray_embree", [&] { cast(embree); }, count},  //
                     {"ray_cgal", [&] { cast(cgal); }, count}},
                    kRounds);
  PrintTime("ray_embree", seconds[0]);
  PrintRatio("ray_embree_vs_cgal", seconds[1] / seconds[0]);
}

// A resampling step: 2,500 objects.
void CompareThreads(const std::vector<TriangleMesh>& meshes, const MetricOptions& options,
                    double* sink) {
  constexpr std::size_t kStep = 2500;
  std::vector<TriangleMesh> step;
  for (std::size_t i = 0; i < kStep; ++i) step.push_back(meshes[i % meshes.size()]);
  const auto run = [&](int threads) {
    return [&, threads] { *sink += ScoreEach(step, options, threads).front().value; };
  };
  const std::vector<double> seconds = MedianSeconds({{"1", run(1)}, {"2", run(2)}}, 1);
  std::printf("time objects_2500_1_thread %.1f s\n", seconds[0]);
  std::printf("time objects_2500_2_threads %.1f s\n", seconds[1]);
  PrintRatio("threads_2_vs_1", seconds[0] / seconds[1]);
}

}  // namespace

void CompareEvaluation() {
  static double sink = 0.0;
  const MetricOptions options;
  const std::vector<TriangleMesh> meshes = RemeshedCylinders(100);
  PrintShares(meshes, options, &sink);
  CompareRays(meshes[0], options, &sink);
  ComparePeer(meshes[0], options, &sink);
  CompareAdaptive(meshes, options, &sink);
  CompareSettled(meshes, options, &sink);
  CompareThreads(meshes, options, &sink);
}

}  // namespace antigrasp::bench
