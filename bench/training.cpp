// Training and sampling against the same networks written the plain way (plain_gan.h) and against
// PyTorch (training_peer.py), in one run: `ratio NAME VALUE`, above 1 = times as fast as the other.
#include <malloc.h>
#include <torch/cuda.h>
#include <torch/types.h>
#include <torch/utils.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "antigrasp/core/error.h"
#include "antigrasp/core/parallel.h"
#include "antigrasp/models/random_tensor.h"
#include "antigrasp/train/gan_trainer.h"
#include "antigrasp/train/torch_threads.h"
#include "bench/arithmetic.h"
#include "bench/peer_process.h"
#include "bench/plain_gan.h"
#include "bench/timing.h"

namespace antigrasp::bench {
namespace {

constexpr int kBatch = 32, kRounds = 5;
constexpr std::int64_t kIterations = 1'000'000;

ModelOptions Model(int width, int pack) {
  ModelOptions options;
  options.width = width;
  options.pack = pack;
  return options;
}

torch::Tensor RandomGrids(std::int64_t count) {
  RngStream rng(1, "grids");
  return NormalTensor({count, 1, 32, 32, 32}, 0.3, &rng).clamp_(-1.0, 1.0);
}

std::unique_ptr<GanTrainer> MakeTrainer(const ModelOptions& model, int batch,
                                        torch::Device device = torch::kCPU,
                                        GanOptions options = {}) {
  options.batch = batch;
  auto trainer = std::make_unique<GanTrainer>(model, options, 1, device);
  trainer->BeginEpisode(0, kIterations, false);
  return trainer;
}

// The largest difference of the outputs of `ours` and `plain` over their largest value.
double RelativeDifference(const torch::Tensor& ours, const torch::Tensor& plain) {
  return ((ours - plain).abs().max() / plain.abs().max()).item<double>();
}

// Nothing below means anything unless both ways compute the same function.
void CheckEquality() {
  for (const int pack : {1, 4}) {
    const ModelOptions model = Model(8, pack);
    Generator generator(model);
    PlainGenerator plain_generator(model);
    plain_generator->CopyFrom(generator);
    Discriminator discriminator(model);
    PlainDiscriminator plain_discriminator(model);
    plain_discriminator->CopyFrom(discriminator);
    RngStream rng(1, "latent");
    const torch::Tensor z = NormalTensor({8, model.latent}, 1.0, &rng), grids = RandomGrids(8);
    const double g = RelativeDifference(generator(z), plain_generator(z));
    const double d = RelativeDifference(discriminator(grids), plain_discriminator(grids));
    std::printf("difference from the plain networks, pack %d: generator %.1e, discriminator %.1e\n",
                pack, g, d);
    if (g > 1e-5 || d > 1e-5) throw RuntimeFailure("the plain networks are not the same function");
  }
}

// Multiply-adds of a plain convolution that suits the machine: 64 to 64 channels, kernel 3.
double ConvolutionRate() {
  torch::NoGradGuard no_grad;
  const torch::Tensor x = torch::rand({32, 64, 16, 16, 16}), w = torch::rand({64, 64, 3, 3, 3});
  at::conv3d(x, w, {}, 1, 1);
  const double seconds =
      MedianSeconds({{"conv3d", [&] { at::conv3d(x, w, {}, 1, 1); }}}, kRounds)[0];
  return 2.0 * 32 * 4096 * 64 * 64 * 27 / seconds;
}

std::unique_ptr<PeerProcess> PythonPeer(const ModelOptions& model, int threads) {
  for (const char* python : {"python3", "/usr/bin/python3"}) {
    auto peer = std::make_unique<PeerProcess>(std::vector<std::string>{
        python, ANTIGRASP_TRAINING_PEER, std::to_string(model.width), std::to_string(model.pack),
        std::to_string(kBatch), std::to_string(threads)});
    if (peer->ready()) return peer;
  }
  return nullptr;
}

// Each contender has all threads in its own way.
void ThreadsForOurs(int threads) { SetTorchThreads(threads, 1); }
void ThreadsForPlain(int threads) { SetTorchThreads(threads, threads); }

void CompareSteps(int width, int pack, int threads) {
  const ModelOptions model = Model(width, pack);
  const std::string name = "_width" + std::to_string(width) +
                           (pack > 1 ? "_pack" + std::to_string(pack) : "") + "_threads" +
                           std::to_string(threads);
  const torch::Tensor shapes = RandomGrids(64);
  const auto ours = MakeTrainer(model, kBatch);
  PlainTrainer plain(model, kBatch);
  ours->Step(shapes);
  plain.Step(shapes);
  const auto peer = PythonPeer(model, threads);
  std::vector<Contender> contenders = {{"ours",
                                        [&] {
                                          ThreadsForOurs(threads);
                                          ours->Step(shapes);
                                          ours->Step(shapes);
                                        },
                                        2},
                                       {"plain", [&] {
                                          ThreadsForPlain(threads);
                                          plain.Step(shapes);
                                        }}};
  if (peer) contenders.push_back({"pytorch", [&] { peer->Work(); }});
  const std::vector<double> seconds = MedianSeconds(contenders, kRounds);
  for (std::size_t i = 0; i < seconds.size(); ++i) {
    PrintTime("step" + name + "_" + contenders[i].name, seconds[i]);
  }
  PrintRatio("step" + name + "_vs_plain_libtorch", seconds[1] / seconds[0]);
  if (peer) {
    PrintRatio("step" + name + "_vs_pytorch", seconds[2] / seconds[0]);
  } else {
    std::printf("left out: PyTorch (python3 cannot import torch)\n");
  }
  ThreadsForPlain(threads);
  const double rate = ConvolutionRate();
  std::printf("rate conv3d_threads%d %.1f GFLOP/s\n", threads, 1e-9 * rate);
  PrintRatio("share_of_conv3d_rate" + name, StepOperations(model, kBatch) / seconds[0] / rate);
}

// A step for every line that is read, answered with its seconds: on the wall, of the processor. At
// the end a number of all that training changed: equal bytes, equal numbers.
void AnswerWithSteps(int width, int pack, int threads) {
  ThreadsForOurs(threads);
  const auto trainer = MakeTrainer(Model(width, pack), kBatch);
  const torch::Tensor shapes = RandomGrids(64);
  for (int i = 0; i < 2; ++i) trainer->Step(shapes);
  std::puts("ready");
  std::fflush(stdout);
  while (std::getchar() != EOF) {
    const std::clock_t before = std::clock();
    const double wall = Seconds([&] { trainer->Step(shapes); });
    std::printf("%.6f %.6f\n", wall, static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC);
    std::fflush(stdout);
  }
  std::string bytes;
  for (const auto& [tensor_name, tensor] : trainer->State()) {
    const torch::Tensor flat = tensor.contiguous();
    bytes.append(static_cast<const char*>(flat.data_ptr()), flat.nbytes());
  }
  std::printf("state %016zx\n", std::hash<std::string>()(bytes));
}

void CompareSteps() {
  for (const int threads : {1, 2}) {
    for (const int width : {8, 16, 32}) {
      for (const int pack : {1, 4}) CompareSteps(width, pack, threads);
    }
  }
}

// Tried: cuDNN's algorithms are timed once and the fastest kept, as training does; graphs: and a
// step is recorded once and replayed. A step ends with a wait for the device: it reports its
// losses.
void CompareDevices() {
  if (!torch::cuda::is_available()) {
    std::printf("left out: CUDA (this LibTorch or this machine has none)\n");
    return;
  }
  SetTorchThreads(HardwareThreads(), 1);
  for (const int width : {8, 16, 32, 64}) {
    std::vector<Contender> contenders;
    for (const auto& [name, device, precision, tries, graphs] :
         {std::tuple("cpu", torch::kCPU, Precision::kFloat32, false, false),
          std::tuple("cuda", torch::kCUDA, Precision::kFloat32, false, false),
          std::tuple("cuda_tried", torch::kCUDA, Precision::kFloat32, true, false),
          std::tuple("cuda_graphs", torch::kCUDA, Precision::kFloat32, true, true),
          std::tuple("cuda_graphs_bfloat16", torch::kCUDA, Precision::kBfloat16, true, true)}) {
      ModelOptions model = Model(width, 4);
      model.pack_at = PackAt::kFeatures;
      model.precision = precision;
      GanOptions gan;
      gan.cuda_graphs = graphs;
      const std::shared_ptr<GanTrainer> trainer = MakeTrainer(model, kBatch, device, gan);
      const torch::Tensor shapes = RandomGrids(64).to(device);
      const int steps = device == torch::kCPU ? 1 : 20;
      const auto work = [=, tries = tries] {
        at::globalContext().setBenchmarkCuDNN(tries);
        for (int i = 0; i < steps; ++i) trainer->Step(shapes);
      };
      work();
      contenders.push_back({name, work, static_cast<double>(steps)});
    }
    const std::vector<double> seconds = MedianSeconds(contenders, 3);
    const std::string name = "device_step_width" + std::to_string(width) + "_";
    for (std::size_t i = 0; i < seconds.size(); ++i) {
      PrintTime(name + contenders[i].name, seconds[i]);
      if (i > 0) PrintRatio(name + contenders[i].name + "_vs_cpu", seconds[0] / seconds[i]);
    }
  }
}

// A resampling step draws 2,500 grids. The plain way draws them in the same batches.
void CompareSampling(int width, int threads) {
  constexpr std::int64_t kCount = 2500;
  const auto ours = MakeTrainer(Model(width, 1), kBatch);
  PlainGenerator plain(Model(width, 1));
  plain->eval();
  ours->Sample(1, 0, kBatch);  // the average's batch statistics are drawn once for its weights
  const auto draw_ours = [&] {
    ThreadsForOurs(threads);
    ours->Sample(1, 0, kCount);
  };
  const auto draw_plain = [&] {
    ThreadsForPlain(threads);
    torch::NoGradGuard no_grad;
    std::vector<torch::Tensor> parts;
    for (std::int64_t i = 0; i < kCount; i += kBatch) {
      parts.push_back(plain(torch::randn({std::min<std::int64_t>(kBatch, kCount - i), 200})));
    }
    torch::cat(parts);
  };
  const std::vector<double> seconds =
      MedianSeconds({{"ours", draw_ours}, {"plain", draw_plain}}, 3);
  const std::string name =
      "sampling_2500_width" + std::to_string(width) + "_threads" + std::to_string(threads);
  PrintTime(name, seconds[0]);
  PrintRatio(name + "_vs_plain_libtorch", seconds[1] / seconds[0]);
}

void CompareSampling() {
  for (const int threads : {1, 2}) {
    for (const int width : {8, 16, 32}) CompareSampling(width, threads);
  }
}

// Most memory the process ever held, MB.
double PeakMemory() {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    if (word == "VmHWM:") {
      double kilobytes = 0.0;
      status >> kilobytes;
      return kilobytes / 1024.0;
    }
  }
  return 0.0;
}

// One process for each cell of the table.
void MeasureMemory(const std::string& program) {
  for (const int width : {8, 16, 32, 64}) {
    for (const int batch : {16, 32, 64}) {
      const std::string command =
          program + " memory " + std::to_string(width) + " " + std::to_string(batch);
      FILE* cell = popen(command.c_str(), "r");
      double megabytes = 0.0;
      const bool read = cell != nullptr && std::fscanf(cell, "%lf", &megabytes) == 1;
      if (cell != nullptr) pclose(cell);
      if (!read) throw RuntimeFailure(command + ": no answer");
      std::printf("memory width %d batch %d: %.0f MB\n", width, batch, megabytes);
      std::fflush(stdout);
    }
  }
}

void TrainAndPrintMemory(int width, int batch) {
  const auto trainer = MakeTrainer(Model(width, 1), batch);
  const torch::Tensor shapes = RandomGrids(64);
  for (int i = 0; i < 3; ++i) trainer->Step(shapes);
  std::printf("%.1f\n", PeakMemory());
}

}  // namespace
}  // namespace antigrasp::bench

int main(int argc, char** argv) {
  using namespace antigrasp::bench;
  mallopt(M_MMAP_THRESHOLD, 1 << 30);  // like the program itself: both ways gain
  mallopt(M_TRIM_THRESHOLD, 1 << 30);
  const std::vector<std::string> named(argv + 1, argv + argc);
  const auto wants = [&](const char* name) {
    return named.empty() || (named.size() == 1 && named[0] == name);
  };
  const bool memory = named.size() == 3 && named[0] == "memory";
  const bool steps = named.size() == 4 && named[0] == "steps";
  if (memory) TrainAndPrintMemory(std::stoi(named[1]), std::stoi(named[2]));
  if (steps) CompareSteps(std::stoi(named[1]), std::stoi(named[2]), std::stoi(named[3]));
  const bool answers = named.size() == 4 && named[0] == "answer";
  if (answers) AnswerWithSteps(std::stoi(named[1]), std::stoi(named[2]), std::stoi(named[3]));
  const bool sampling = named.size() == 3 && named[0] == "sampling";
  if (sampling) CompareSampling(std::stoi(named[1]), std::stoi(named[2]));
  bool known = memory || steps || answers || sampling;
  const std::vector<std::pair<const char*, std::function<void()>>> comparisons = {
      {"equality", CheckEquality},
      {"steps", [] { CompareSteps(); }},
      {"sampling", [] { CompareSampling(); }},
      {"memory", [&] { MeasureMemory(argv[0]); }},
      {"devices", CompareDevices}};
  for (const auto& [name, compare] : comparisons) {
    if (!wants(name)) continue;
    known = true;
    compare();
  }
  if (known) return 0;
  std::fprintf(
      stderr,
      "bench_training [equality | steps [WIDTH PACK THREADS] | answer WIDTH PACK THREADS | "
      "sampling [WIDTH THREADS] | memory | devices]\n");
  return 2;
}
