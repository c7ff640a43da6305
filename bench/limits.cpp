// How near the hot paths come to what the machine can do, one thread, limits measured in the same
// run: a Markdown table. Processor time, the least of some rounds.
#include <embree3/rtcore.h>
#include <malloc.h>

#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include "antigrasp/datasets/chamfer.h"
#include "antigrasp/datasets/surface_comparison.h"
#include "antigrasp/models/random_tensor.h"
#include "antigrasp/quality/graspability.h"
#include "antigrasp/quality/jaw_closing.h"
#include "antigrasp/quality/robust_quality.h"
#include "antigrasp/train/gan_trainer.h"
#include "antigrasp/train/torch_threads.h"
#include "bench/arithmetic.h"
#include "bench/bench_objects.h"
#include "bench/machine_limits.h"

namespace antigrasp::bench {
namespace {

constexpr int kRounds = 5, kBatch = 32, kObjects = 10;

void PrintRow(const std::string& path, const std::string& does, const std::string& limit,
              double share) {
  std::printf("| %s | %s | %s | %.0f %% |\n", path.c_str(), does.c_str(), limit.c_str(),
              100 * share);
  std::fflush(stdout);
}

std::string Text(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

void Training(double peak, double memory) {
  SetTorchThreads(1, 1);
  for (const int width : {8, 16, 32}) {
    ModelOptions model;
    model.width = width;
    GanOptions gan;
    gan.batch = kBatch;
    GanTrainer trainer(model, gan, 1, torch::kCPU);
    trainer.BeginEpisode(0, 1'000'000, false);
    RngStream rng(1, "grids");
    const torch::Tensor shapes = NormalTensor({64, 1, 32, 32, 32}, 0.3, &rng).clamp_(-1.0, 1.0);
    trainer.Step(shapes);
    const double step = LeastThreadSeconds([&] { trainer.Step(shapes); }, kRounds);
    const std::string name = "an update at width " + std::to_string(width);
    const double rate = StepOperations(model, kBatch) / step;
    PrintRow(name, Text("%.0f GFLOP/s as written", 1e-9 * rate), "multiply-adds", rate / peak);
    const double moved = StepBytes(model, kBatch) / step;
    PrintRow(name, Text("%.1f GB/s at least", 1e-9 * moved), "memory", moved / memory);
    trainer.Sample(1, 0, kBatch);  // the average's statistics are drawn once
    constexpr int kGrids = 128;
    const double draw = LeastThreadSeconds([&] { trainer.Sample(1, 0, kGrids); }, kRounds);
    const double drawn = SampleOperations(model, kGrids) / draw;
    PrintRow("drawing at width " + std::to_string(width),
             Text("%.0f GFLOP/s as written", 1e-9 * drawn), "multiply-adds", drawn / peak);
  }
}

// The rays of a grasp's draws, as scoring closes its jaws.
struct Draws {
  TriangleMesh mesh;  // metres
  std::vector<JawClosing> closings;
};

Draws DrawsOf(const TriangleMesh& unit_mesh, const MetricOptions& options) {
  Draws draws{InMetres(unit_mesh), {}};
  const Eigen::Vector3d com = CenterOfMass(draws.mesh);
  const Graspability score = EvaluateGraspability(unit_mesh, options, 1, 0);
  for (std::size_t g = 0; g < score.grasps.size(); ++g) {
    RngStream rng(1, "noise", 0, g);
    for (int draw = 0; draw < options.num_draws; ++draw) {
      const NoiseDraw noise = DrawNoise(options, &rng);
      const JawPose pose = ExecutedPose(score.grasps[g].grasp, com, noise);
      draws.closings.push_back({pose.center, pose.axis, noise.friction});
    }
  }
  return draws;
}

// Embree alone: its tree, rays in float, nothing before or after them.
class PlainEmbree {
 public:
  explicit PlainEmbree(const TriangleMesh& mesh) : device_(rtcNewDevice("threads=1")) {
    scene_ = rtcNewScene(device_);
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* at = static_cast<float*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, mesh.vertices.size()));
    for (const Eigen::Vector3d& v : mesh.vertices) {
      for (int k = 0; k < 3; ++k) *at++ = static_cast<float>(v[k]);
    }
    auto* corner = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, mesh.faces.size()));
    for (const auto& face : mesh.faces) {
      for (const std::int32_t v : face) *corner++ = static_cast<unsigned>(v);
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_);
  }
  ~PlainEmbree() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  PlainEmbree(const PlainEmbree&) = delete;
  PlainEmbree& operator=(const PlainEmbree&) = delete;

  // Both jaws' rays; how many meet a face.
  int Cast(const std::vector<JawClosing>& closings, double opening) const {
    int met = 0;
    for (const JawClosing& jaw : closings) {
      for (const double side : {-1.0, 1.0}) {
        const Eigen::Vector3f from = (jaw.center + side * 0.5 * opening * jaw.axis).cast<float>();
        const Eigen::Vector3f along = (-side * jaw.axis).cast<float>();
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        RTCRayHit hit{};
        hit.ray = {from.x(),    from.y(),  from.z(),
                   0.0F,        along.x(), along.y(),
                   along.z(),   0.0F,      static_cast<float>(0.5 * opening),
                   0xFFFFFFFFU, 0,         0};
        hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        rtcIntersect1(scene_, &context, &hit);
        met += hit.hit.geomID != RTC_INVALID_GEOMETRY_ID ? 1 : 0;
      }
    }
    return met;
  }

 private:
  RTCDevice device_;
  RTCScene scene_ = nullptr;
};

void Scoring(const std::vector<TriangleMesh>& meshes) {
  const MetricOptions options;
  double ours = 0.0, embree = 0.0, whole = 0.0, rays = 0.0;
  volatile double sink = 0.0;
  const auto each = static_cast<std::size_t>(options.num_draws);
  std::vector<std::optional<std::array<Contact, 2>>> contacts(each);
  for (int i = 0; i < kObjects; ++i) {
    const TriangleMesh& mesh = meshes[static_cast<std::size_t>(i)];
    const Draws draws = DrawsOf(mesh, options);
    const RayScene scene(draws.mesh);
    const PlainEmbree plain(draws.mesh);
    const auto close = [&] {
      for (std::size_t first = 0; first + each <= draws.closings.size(); first += each) {
        CloseJawsTogether(scene, std::span(&draws.closings[first], each), options.jaw_opening,
                          contacts);
        sink = sink + (contacts[0] ? 1.0 : 0.0);
      }
    };
    close();  // builds what it needs
    ours += LeastThreadSeconds(close, kRounds);
    embree += LeastThreadSeconds(
        [&] { sink = sink + plain.Cast(draws.closings, options.jaw_opening); }, kRounds);
    whole += LeastThreadSeconds(
        [&] { sink = sink + EvaluateGraspability(mesh, options, 1, 0).value; }, kRounds);
    rays += 2.0 * static_cast<double>(draws.closings.size());
  }
  PrintRow("jaws that close, " + Text("%.0f %% of scoring", 100 * ours / whole),
           Text("%.1f million rays a second", 1e-6 * rays / ours),
           Text("Embree's rays alone, %.1f million", 1e-6 * rays / embree), embree / ours);
}

void Comparing(const std::vector<TriangleMesh>& meshes, double peak) {
  for (const int points : {1024, 4096}) {
    std::vector<PointSet> sets;
    for (std::size_t i = 0; i < kObjects; ++i) {
      sets.push_back(SurfacePoints(meshes[i], points, 1, 0, i));
    }
    volatile double sink = 0.0;
    const double seconds = LeastThreadSeconds(
        [&] {
          for (std::size_t i = 0; i + 1 < kObjects; ++i) {
            sink = sink + Chamfer(sets[i], sets[i + 1]);
          }
        },
        kRounds);
    const double all = 2.0 * points * points * 6.0 * (kObjects - 1) / peak;
    PrintRow("Chamfer distance, " + std::to_string(points) + " points",
             Text("%.2f ms", 1e3 * seconds / (kObjects - 1)),
             Text("all pairs as multiply-adds, %.2f ms", 1e3 * all / (kObjects - 1)),
             all / seconds);
  }
}

void Print() {
  const double eight = PeakRateOfEight(), sixteen = PeakRateOfSixteen(), memory = MemoryRate();
  std::printf("one thread: %.0f GFLOP/s in vectors of 8, %.0f of 16; memory %.1f GB/s\n\n",
              1e-9 * eight, 1e-9 * sixteen, 1e-9 * memory);
  std::printf("| hot path | does | limit | share |\n| --- | --- | --- | --- |\n");
  const std::vector<TriangleMesh> meshes = RemeshedCylinders(kObjects);
  Scoring(meshes);
  Comparing(meshes, eight);
  Training(std::max(eight, sixteen), memory);
}

}  // namespace
}  // namespace antigrasp::bench

int main() {
  mallopt(M_MMAP_THRESHOLD, 1 << 30);  // as the program does
  mallopt(M_TRIM_THRESHOLD, 1 << 30);
  antigrasp::bench::Print();
}
