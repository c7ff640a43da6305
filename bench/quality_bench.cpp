// Single timings of the metric's parts: bench_quality --benchmark_filter=...
#include <benchmark/benchmark.h>

#include "antigrasp/quality/epsilon.h"
#include "antigrasp/quality/graspability.h"
#include "bench/bench_objects.h"
#include "bench/peer_evaluation.h"
#include "tests/quality/random_grasps.h"

namespace antigrasp {
namespace {

RandomGrasp GraspNumber(std::int64_t i) {
  RngStream rng(1, "bench", static_cast<std::uint64_t>(i));
  RandomGrasp grasp = DrawRandomGrasp(0.9, 8, &rng);
  grasp.model = WrenchModel{};
  return grasp;
}

void BM_Epsilon(benchmark::State& state) {
  std::vector<RandomGrasp> grasps;
  for (int i = 0; i < 256; ++i) grasps.push_back(GraspNumber(i));
  std::size_t i = 0;
  for (auto _ : state) {
    const RandomGrasp& grasp = grasps[i++ % grasps.size()];
    benchmark::DoNotOptimize(Epsilon(grasp.contacts, grasp.com, grasp.model));
  }
}
BENCHMARK(BM_Epsilon);

void BM_EpsilonByQhull(benchmark::State& state) {
  const RandomGrasp grasp = GraspNumber(0);
  for (auto _ : state) {
    benchmark::DoNotOptimize(bench::EpsilonByQhull(grasp.contacts, grasp.com, grasp.model));
  }
}
BENCHMARK(BM_EpsilonByQhull);

void BM_EpsilonByConeEdges(benchmark::State& state) {
  RandomGrasp grasp = GraspNumber(0);
  grasp.model.cone_edges = static_cast<int>(state.range(0));
  for (auto _ : state) {
    benchmark::DoNotOptimize(Epsilon(grasp.contacts, grasp.com, grasp.model));
  }
}
BENCHMARK(BM_EpsilonByConeEdges)->Arg(4)->Arg(8)->Arg(16)->Arg(32);

void BM_Graspability(benchmark::State& state) {
  const TriangleMesh mesh = bench::RemeshedCylinders(1).front();
  MetricOptions options;
  options.num_grasps = static_cast<int>(state.range(0));
  options.num_draws = static_cast<int>(state.range(1));
  for (auto _ : state) benchmark::DoNotOptimize(EvaluateGraspability(mesh, options, 1, 0).value);
}
BENCHMARK(BM_Graspability)
    ->Args({100, 1})
    ->Args({100, 25})
    ->Args({400, 25})
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace antigrasp

BENCHMARK_MAIN();
