#include "antigrasp/train/torch_threads.h"

#include <ATen/Parallel.h>
#include <gtest/gtest.h>
#include <torch/types.h>

#include "antigrasp/core/pieces.h"
#include "antigrasp/models/cell_conv.h"
#include "antigrasp/train/gan_trainer.h"

namespace antigrasp {
namespace {

class TorchThreads : public testing::Test {
 protected:
  ~TorchThreads() override { SetTorchThreads(ours_, of_libtorch_); }
  const int ours_ = PieceThreads(), of_libtorch_ = at::get_num_threads();
};

TEST_F(TorchThreads, TrainingAndSamplesHaveTheSameBitsForAnyNumber) {
  if (!HasCellConv()) GTEST_SKIP() << "no AVX2: LibTorch's convolutions do the work";
  GanOptions gan;
  gan.batch = 8;
  ModelOptions model;
  model.width = 16;
  model.pack = 2;
  model.edge_gain = 1.0;
  const torch::Tensor shapes =
      torch::linspace(-1, 1, 4 * 32 * 32 * 32).sin().view({4, 1, 32, 32, 32});
  NamedTensors first;
  for (const int threads : {1, 2, 3}) {
    SetTorchThreads(threads, ThreadsOfLibTorch(model, /*on_cpu=*/true, threads));
    GanTrainer trainer(model, gan, 3, torch::kCPU);
    trainer.BeginEpisode(0, 3, true);
    for (int step = 0; step < 3; ++step) trainer.Step(shapes);
    NamedTensors all = trainer.State();
    all.emplace_back("samples", trainer.Sample(1, 0, 3));
    if (first.empty()) first = all;
    for (std::size_t i = 0; i < all.size(); ++i) {
      EXPECT_TRUE(torch::equal(all[i].second, first[i].second))
          << all[i].first << ", " << threads << " threads";
    }
  }
}

TEST_F(TorchThreads, LibTorchHasThemWhereItsConvolutionsDoTheWork) {
  const ModelOptions plain;
  EXPECT_EQ(ThreadsOfLibTorch(plain, true, 5), HasCellConv() ? 1 : 5);
  EXPECT_EQ(ThreadsOfLibTorch(plain, false, 5), 5);
  ModelOptions other = plain;
  other.precision = Precision::kBfloat16;
  EXPECT_EQ(ThreadsOfLibTorch(other, true, 5), 5);
  other = plain;
  other.block = Block::kResidualGenerator;
  EXPECT_EQ(ThreadsOfLibTorch(other, true, 5), 5);
  other = plain;
  other.width = 12;
  EXPECT_EQ(ThreadsOfLibTorch(other, true, 5), 5);
  other = plain;
  other.width_d = 12;
  EXPECT_EQ(ThreadsOfLibTorch(other, true, 5), 5);
  SetTorchThreads(3, 2);
  EXPECT_EQ(PieceThreads(), 3);
  EXPECT_EQ(at::get_num_threads(), 2);
}

}  // namespace
}  // namespace antigrasp
