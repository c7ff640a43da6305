#include "antigrasp/train/captured_gradients.h"

#ifdef ANTIGRASP_CUDA_GRAPHS
#include <ATen/cuda/CUDAGraph.h>
#include <c10/cuda/CUDAGuard.h>
#include <c10/cuda/CUDAStream.h>
#include <torch/cuda.h>

#include <string>
#include <utility>

#include "antigrasp/core/error.h"
#endif

namespace antigrasp {

#ifdef ANTIGRASP_CUDA_GRAPHS

namespace {

using Pool = decltype(std::declval<at::cuda::CUDAGraph&>().pool());

constexpr int kWarmUp = 3;  // cuDNN tries its algorithms and libraries make their handles

}  // namespace

// The generator's graph is recorded right after the discriminator's: it goes back through what that
// one generated, so both share one pool of memory and are always replayed in turn.
struct CapturedGradients::Graphs {
  explicit Graphs(torch::Device device)
      : stream(c10::cuda::getStreamFromPool(/*isHighPriority=*/false,
                                            device.has_index() ? device.index() : 0)) {}

  template <class Work>
  LossAndGradients OnOwnStream(const Work& work) {
    torch::cuda::synchronize();
    LossAndGradients found;
    {
      const c10::cuda::CUDAStreamGuard guard(stream);
      found = work();
    }
    torch::cuda::synchronize();
    return found;
  }

  template <class Work>
  LossAndGradients Record(at::cuda::CUDAGraph* graph, Pool pool, const Work& work) {
    try {
      return OnOwnStream([&] {
        graph->capture_begin(pool);
        LossAndGradients found = work();
        graph->capture_end();
        return found;
      });
    } catch (const c10::Error& error) {
      throw RuntimeFailure(
          "a step could not be recorded as a CUDA graph (gan.cuda_graphs = false "
          "goes without): " +
          std::string(error.what_without_backtrace()));
    }
  }

  c10::cuda::CUDAStream stream;
  int calls = 0;  // of OfDiscriminator
  at::cuda::CUDAGraph discriminator, generator;
  GanPart part{RngStream(0, "unused"), {}, {}};  // what the recorded kernels read
  LossAndGradients of_discriminator, of_generator;
};

CapturedGradients::CapturedGradients(const GanGradients& gradients, const GanOptions& options,
                                     torch::Device device)
    : gradients_(gradients) {
  if (options.cuda_graphs && device.is_cuda() && options.augment == Augmentation::kNone &&
      options.micro_batches == 0 && options.discriminator_steps == 1) {
    graphs_ = std::make_unique<Graphs>(device);
  }
}

LossAndGradients CapturedGradients::OfDiscriminator(GanPart* part) {
  if (!graphs_) return gradients_.OfDiscriminator(part);
  Graphs& g = *graphs_;
  const int call = g.calls;
  if (call <= kWarmUp) ++g.calls;
  if (call < kWarmUp) return g.OnOwnStream([&] { return gradients_.OfDiscriminator(part); });
  if (call == kWarmUp) {
    g.part.real = part->real.clone();
    g.part.z = part->z.clone();
    g.of_discriminator =
        g.Record(&g.discriminator, {0, 0}, [&] { return gradients_.OfDiscriminator(&g.part); });
    g.of_generator = g.Record(&g.generator, g.discriminator.pool(),
                              [&] { return gradients_.OfGenerator(&g.part); });
  } else {
    g.part.real.copy_(part->real);
    g.part.z.copy_(part->z);
  }
  g.discriminator.replay();
  return g.of_discriminator;
}

LossAndGradients CapturedGradients::OfGenerator(GanPart* part) {
  if (!graphs_) return gradients_.OfGenerator(part);
  if (graphs_->calls <= kWarmUp) {
    return graphs_->OnOwnStream([&] { return gradients_.OfGenerator(part); });
  }
  graphs_->generator.replay();
  return graphs_->of_generator;
}

bool HasCapture() { return true; }

#else

struct CapturedGradients::Graphs {};

CapturedGradients::CapturedGradients(const GanGradients& gradients, const GanOptions&,
                                     torch::Device)
    : gradients_(gradients) {}

LossAndGradients CapturedGradients::OfDiscriminator(GanPart* part) {
  return gradients_.OfDiscriminator(part);
}

LossAndGradients CapturedGradients::OfGenerator(GanPart* part) {
  return gradients_.OfGenerator(part);
}

bool HasCapture() { return false; }

#endif

CapturedGradients::~CapturedGradients() = default;

}  // namespace antigrasp
