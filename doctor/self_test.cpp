#include "antigrasp/doctor/self_test.h"

#include "antigrasp/core/rng.h"
#include "antigrasp/datasets/object_names.h"
#include "antigrasp/datasets/prior_set.h"
#include "antigrasp/perturb/random_perturbation.h"
#include "antigrasp/quality/graspability.h"
#include "antigrasp/sdf/remesh.h"
#include "antigrasp/trial/physics_trial.h"

namespace antigrasp {
namespace {

// What `antigrasp doctor` found (it prints what it found beside what it expected) in a build by GCC
// 12 with Debian 12's libraries. Where one has to be changed, results of users change with it.
constexpr std::uint64_t kMade = 0xd12ffb4145092396, kRemeshed = 0xaae7d0fdcb365c62,
                        kScored = 0xf1055231e80ff273, kPerturbed = 0x0300c7adfdcf529c,
                        kTried = 0x503900859ac349e2;
constexpr const char* kMujocoOfTried = "2.2.2";

SelfTestStep Made(const ShapeSet& shapes) {
  HashedBytes bytes;
  for (const SdfGrid& grid : shapes.grids) bytes.Add(grid.values);
  return {"made", bytes.Hash(), kMade};
}

SelfTestStep Remeshed(const std::vector<TriangleMesh>& meshes) {
  HashedBytes bytes;
  for (const TriangleMesh& mesh : meshes) {
    bytes.Add(mesh.vertices);
    bytes.Add(mesh.faces);
  }
  return {"remeshed", bytes.Hash(), kRemeshed};
}

SelfTestStep Scored(const ShapeSet& shapes, const std::vector<TriangleMesh>& meshes, int threads) {
  const auto at = [](std::int64_t i) { return static_cast<std::size_t>(i); };
  const std::vector<Graspability> scores = ScoreAll(
      std::ssize(meshes), [&](std::int64_t i) { return &meshes[at(i)]; },
      [&](std::int64_t i) { return StreamOf(shapes.names[at(i)]); }, MetricOptions(), 1, threads);
  HashedBytes bytes;
  for (const Graspability& score : scores) {
    for (const ScoredGrasp& grasp : score.grasps) bytes.Add(&grasp.quality, 1);
  }
  return {"scored", bytes.Hash(), kScored};
}

SelfTestStep Perturbed(const TriangleMesh& mesh) {
  const PerturbOptions common;
  RngStream rng(1, "doctor");
  const PerturbResult result =
      PerturbRandomly(mesh, PairLimitsOf(common, MetricOptions().friction, 1.0), common,
                      {.iterations = 1000}, &rng);
  HashedBytes bytes;
  bytes.Add(result.mesh.vertices);
  return {"perturbed", bytes.Hash(), kPerturbed};
}

SelfTestStep Tried(const TriangleMesh& mesh, std::uint64_t stream, int threads) {
  MetricOptions metric;
  metric.num_grasps = 10;
  PhysicsTrialOptions options;
  options.draws = 1;
  const PhysicsTrial trial = PhysicsTrials(metric, options, 1, threads).Try(mesh, stream);
  HashedBytes bytes;
  for (const ExecutedGrasp& grasp : trial.grasps) {
    for (const ExecutedDraw& draw : grasp.draws) {
      const auto outcome = static_cast<std::int32_t>(draw.execution.outcome);
      bytes.Add(&outcome, 1);
      bytes.Add(&draw.execution.closing_move, 1);
      bytes.Add(&draw.execution.seconds, 1);
    }
  }
  SelfTestStep step{"tried", bytes.Hash(), {}};
  if (MujocoVersion() == kMujocoOfTried) step.expected = kTried;
  return step;
}

}  // namespace

std::vector<SelfTestStep> RunSelfTest(int threads, RunObserver* observer) {
  const ProgressFn progress = observer->Phase("computing what is known");
  const ShapeSet shapes =
      MakePriorSet({.kind = "cylinders", .count = 2, .seed = 1, .threads = threads});
  std::vector<TriangleMesh> meshes;
  for (const SdfGrid& grid : shapes.grids) meshes.push_back(Remesh(grid).mesh);
  std::vector<SelfTestStep> steps = {Made(shapes), Remeshed(meshes)};
  progress(1, 4);
  steps.push_back(Scored(shapes, meshes, threads));
  progress(2, 4);
  steps.push_back(Perturbed(meshes.front()));
  progress(3, 4);
  if (!MujocoVersion().empty()) {
    steps.push_back(Tried(meshes.front(), StreamOf(shapes.names.front()), threads));
  }
  progress(4, 4);
  return steps;
}

}  // namespace antigrasp
