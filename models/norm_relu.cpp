#include "antigrasp/models/norm_relu.h"

#include <torch/csrc/autograd/custom_function.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "antigrasp/core/pieces.h"
#include "antigrasp/models/folding.h"
#include "antigrasp/models/norm_rows.h"

namespace antigrasp {
namespace {

using torch::autograd::AutogradContext;
using torch::autograd::Function;
using torch::autograd::variable_list;

constexpr std::int64_t kChunk = 256;  // rows summed in float; chunks are then added up in double

// A tensor as rows of channels, and how many there are of each.
struct Rows {
  explicit Rows(const at::Tensor& x) : channels(x.size(1)), count(x.numel() / x.size(1)) {}

  // Calls visit(chunk, first row, end row), each chunk in one thread.
  template <typename Visit>
  void ForChunks(const Visit& visit) const {
    ForRanges(Chunks(), std::max<std::int64_t>(1, 256 / channels),
              [&](std::int64_t begin, std::int64_t end) {
                for (std::int64_t i = begin; i < end; ++i) {
                  visit(i, i * kChunk, std::min(count, (i + 1) * kChunk));
                }
              });
  }
  std::int64_t Chunks() const { return (count + kChunk - 1) / kChunk; }

  std::int64_t channels, count;
};

struct Moments {
  at::Tensor mean, variance;  // [C] float; the variance over n, not n - 1
};

// Each chunk's sum and squares about its own mean, put together in double (Chan, Golub and LeVeque,
// Updating Formulae and a Pairwise Algorithm for Computing Sample Variances, 1979): one pass over
// memory, and no cancellation.
Moments MomentsOf(const at::Tensor& x) {
  const Rows rows(x);
  const std::int64_t channels = rows.channels;
  const float* values = x.data_ptr<float>();
  std::vector<float> sums(rows.Chunks() * channels), squares(sums.size());
  rows.ForChunks([&](std::int64_t chunk, std::int64_t begin, std::int64_t end) {
    const float* from = values + begin * channels;
    float* sum = sums.data() + chunk * channels;
    norm::Sum(from, end - begin, channels, sum);
    std::vector<float> mean(channels);
    for (std::int64_t c = 0; c < channels; ++c) mean[c] = sum[c] / static_cast<float>(end - begin);
    norm::SumSquares(from, end - begin, channels, mean.data(), squares.data() + chunk * channels);
  });
  Moments moments{at::empty({channels}, x.options()), at::empty({channels}, x.options())};
  for (std::int64_t c = 0; c < channels; ++c) {
    double n = 0.0, total = 0.0, square = 0.0;
    for (std::int64_t i = 0; i < rows.Chunks(); ++i) {
      const double m = static_cast<double>(std::min(kChunk, rows.count - i * kChunk));
      const double sum = sums[i * channels + c];
      const double apart = n > 0.0 ? sum / m - total / n : 0.0;
      square += squares[i * channels + c] + apart * apart * n * m / (n + m);
      n += m;
      total += sum;
    }
    moments.mean.data_ptr<float>()[c] = static_cast<float>(total / n);
    moments.variance.data_ptr<float>()[c] = static_cast<float>(square / n);
  }
  return moments;
}

// y = relu(scale x + shift), channel by channel.
at::Tensor ScaleAndCut(const at::Tensor& x, const at::Tensor& scale, const at::Tensor& shift) {
  at::Tensor result = at::empty_like(x);
  const Rows rows(x);
  const norm::Cut cut{scale.data_ptr<float>(), shift.data_ptr<float>()};
  const float* from = x.data_ptr<float>();
  float* to = result.data_ptr<float>();
  rows.ForChunks([&](std::int64_t, std::int64_t begin, std::int64_t end) {
    const std::int64_t first = begin * rows.channels;
    norm::ScaleAndCut(from + first, end - begin, rows.channels, cut, to + first);
  });
  return result;
}

// [2, C] double: the sums of g and of g (x - mean) over the rows that were not cut.
at::Tensor GradientSums(const at::Tensor& x, const at::Tensor& g, const at::Tensor& scale,
                        const at::Tensor& shift, const at::Tensor& mean) {
  const Rows rows(x);
  const std::int64_t channels = rows.channels;
  const norm::Cut cut{scale.data_ptr<float>(), shift.data_ptr<float>()};
  const float *values = x.data_ptr<float>(), *slopes = g.data_ptr<float>();
  const float* center = mean.data_ptr<float>();
  std::vector<float> sums(rows.Chunks() * channels * 2);
  rows.ForChunks([&](std::int64_t chunk, std::int64_t begin, std::int64_t end) {
    float* plain = sums.data() + chunk * 2 * channels;
    norm::SumGradients(values + begin * channels, slopes + begin * channels, end - begin, channels,
                       cut, center, plain, plain + channels);
  });
  at::Tensor result = at::zeros({2, channels}, at::kDouble);
  double* total = result.data_ptr<double>();
  for (std::size_t i = 0; i < sums.size(); ++i) total[i % (2 * channels)] += sums[i];
  return result;
}

// scale g + slope x + offset where x was not cut, slope x + offset elsewhere.
at::Tensor InputGradient(const at::Tensor& x, const at::Tensor& g, const at::Tensor& scale,
                         const at::Tensor& shift, const at::Tensor& slope,
                         const at::Tensor& offset) {
  at::Tensor result = at::empty_like(x);
  const Rows rows(x);
  const norm::Cut cut{scale.data_ptr<float>(), shift.data_ptr<float>()};
  const float *values = x.data_ptr<float>(), *slopes = g.data_ptr<float>();
  const float *u = slope.data_ptr<float>(), *v = offset.data_ptr<float>();
  float* to = result.data_ptr<float>();
  rows.ForChunks([&](std::int64_t, std::int64_t begin, std::int64_t end) {
    const std::int64_t first = begin * rows.channels;
    norm::InputGradient(values + first, slopes + first, end - begin, rows.channels, cut, u, v,
                        to + first);
  });
  return result;
}

// relu(weight (x - mean) / deviation + bias) where mean and deviation are those of x: its gradient
// is right in training only.
struct NormReluFunction : Function<NormReluFunction> {
  static at::Tensor forward(AutogradContext* ctx, const at::Tensor& x, const at::Tensor& weight,
                            const at::Tensor& bias, const at::Tensor& mean,
                            const at::Tensor& deviation) {
    const at::Tensor scale = weight / deviation, shift = bias - mean * scale;
    ctx->save_for_backward({x, mean, deviation, scale, shift});
    return ScaleAndCut(x, scale, shift);
  }
  static variable_list backward(AutogradContext* ctx, variable_list grads) {
    const variable_list saved = ctx->get_saved_variables();
    const at::Tensor &x = saved[0], &mean = saved[1], &deviation = saved[2], &scale = saved[3];
    const at::Tensor g = grads[0].contiguous(kChannelsLast);
    const at::Tensor sums = GradientSums(x, g, scale, saved[4], mean);
    const double n = static_cast<double>(Rows(x).count);
    const at::Tensor slope = -scale * sums[1] / (n * deviation.square());
    const at::Tensor offset = -scale * sums[0] / n - slope * mean;
    const at::Tensor input =
        InputGradient(x, g, scale, saved[4], slope.to(at::kFloat), offset.to(at::kFloat));
    return {input, (sums[1] / deviation).to(at::kFloat), sums[0].to(at::kFloat), at::Tensor(),
            at::Tensor()};
  }
};

// As BatchNorm3d does: the running variance over n - 1.
void UpdateStatistics(const Moments& moments, double n, torch::nn::BatchNorm3dImpl* norm) {
  norm->num_batches_tracked += 1;
  const auto momentum = norm->options.momentum();
  const double step =
      momentum ? *momentum
               : 1.0 / static_cast<double>(norm->num_batches_tracked.item<std::int64_t>());
  norm->running_mean.mul_(1.0 - step).add_(moments.mean, step);
  norm->running_var.mul_(1.0 - step).add_(moments.variance, step * n / (n - 1.0));
}

}  // namespace

torch::Tensor NormRelu(torch::nn::BatchNorm3d& norm, const torch::Tensor& x) {
  const bool learns = norm->is_training();
  if (!x.device().is_cpu() || x.scalar_type() != at::kFloat || x.numel() <= x.size(1) ||
      (!learns && torch::GradMode::is_enabled())) {
    return norm(x).relu_();
  }
  const torch::Tensor rows = x.contiguous(kChannelsLast);
  Moments moments{norm->running_mean, norm->running_var};
  if (learns) {
    torch::NoGradGuard no_grad;
    moments = MomentsOf(rows);
    UpdateStatistics(moments, static_cast<double>(Rows(x).count), norm.get());
  }
  const torch::Tensor deviation = (moments.variance + norm->options.eps()).sqrt();
  return NormReluFunction::apply(rows, norm->weight, norm->bias, moments.mean, deviation);
}

}  // namespace antigrasp
