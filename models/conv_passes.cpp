#include <ATen/ATen.h>
#include <torch/csrc/autograd/custom_function.h>

#include "antigrasp/models/fold_cells.h"
#include "antigrasp/models/folded_conv.h"
#include "antigrasp/models/folding.h"
#include "antigrasp/models/winograd_conv.h"

// Convolutions together with the folding before or behind them: a large layer's cells are some
// 25 MB, which else go to memory and come back.
namespace antigrasp {
namespace {

using torch::autograd::AutogradContext;
using torch::autograd::Function;
using torch::autograd::variable_list;

// Of a convolution that sees `values` [N, C, s, s, s] or gives them, folded.
CellConvShape ShapeOfGrid(const at::Tensor& values, const at::Tensor& weight) {
  return {values.size(0), values.size(2) / 2 + 1, 8 * values.size(1), weight.size(0)};
}

bool PassesSampleBySample(const at::Tensor& x, const CellConvShape& shape, const at::Tensor& weight,
                          at::ScalarType compute) {
  return TakesCellConv(x, weight, compute) && SuitsSampleBySample(shape);
}

// cells [N, 8 C, h, h, h], each made by fill(number, its cells), and what Convolve makes of them.
template <typename Fill>
at::Tensor ConvolveFilled(const CellConvShape& s, const Fill& fill, const at::Tensor& cells,
                          const at::Tensor& weight, const at::Tensor& bias) {
  const std::int64_t g = s.h - 1, size = cells.numel() / s.count;
  const at::Tensor b = bias.defined() ? bias.contiguous() : bias;
  at::Tensor result = at::empty({s.count, s.out, g, g, g}, cells.options(), kChannelsLast);
  float* first = cells.data_ptr<float>();
  WinogradConvOfFilled(
      s, [&](std::int64_t i) { fill(i, first + i * size); }, first,
      weight.contiguous().data_ptr<float>(), b.defined() ? b.data_ptr<float>() : nullptr,
      result.data_ptr<float>());
  return result;
}

// A grid [N, C, s, s, s] of which take(number, cells, to) makes a sample of what ConvolveTransposed
// would give.
template <typename Take>
at::Tensor ConvolveTransposedTaken(const CellConvShape& s, const at::Tensor& values,
                                   const at::Tensor& weight, const Take& take) {
  const std::int64_t side = 2 * s.h - 2, channels = s.in / 8;
  const at::Tensor x = values.contiguous(kChannelsLast);
  at::Tensor result =
      at::empty({s.count, channels, side, side, side}, values.options(), kChannelsLast);
  float* first = result.data_ptr<float>();
  const std::int64_t size = result.numel() / s.count;
  WinogradConvTransposeTaken(
      s, x.data_ptr<float>(), weight.contiguous().data_ptr<float>(),
      [&](std::int64_t i, const float* cells) { take(i, cells, first + i * size); });
  return result;
}

// Shapes that pass sample by sample.
struct DownConvLeakyFunction : Function<DownConvLeakyFunction> {
  static at::Tensor forward(AutogradContext* ctx, const at::Tensor& grid, const at::Tensor& weight,
                            const at::Tensor& bias, double leak) {
    const CellConvShape s = ShapeOfGrid(grid, weight);
    const at::Tensor x = grid.contiguous(kChannelsLast);
    const at::Tensor cells = at::empty({s.count, s.in, s.h, s.h, s.h}, x.options(), kChannelsLast);
    ctx->save_for_backward({cells, weight});
    ctx->saved_data["leak"] = leak;
    const float* first = x.data_ptr<float>();
    const std::int64_t size = x.numel() / s.count;
    const auto fill = [&](std::int64_t i, float* to) {
      FoldLeakyNodes(first + i * size, static_cast<int>(x.size(2)), static_cast<int>(x.size(1)),
                     static_cast<float>(leak), to);
    };
    return ConvolveFilled(s, fill, cells, weight, bias);
  }
  static variable_list backward(AutogradContext* ctx, variable_list grads) {
    const variable_list saved = ctx->get_saved_variables();
    const at::Tensor &cells = saved[0], &weight = saved[1];
    const auto leak = static_cast<float>(ctx->saved_data["leak"].toDouble());
    at::Tensor of_grid, of_weight, of_bias;
    if (ctx->needs_input_grad(0)) {
      const CellConvShape s{cells.size(0), cells.size(2), cells.size(1), weight.size(0)};
      const float* first = cells.data_ptr<float>();
      const std::int64_t size = cells.numel() / s.count;
      of_grid = ConvolveTransposedTaken(
          s, grads[0], weight, [&](std::int64_t i, const float* slopes, float* to) {
            UnfoldLeakySlopes(slopes, first + i * size, static_cast<int>(2 * s.h - 2),
                              static_cast<int>(s.in / 8), leak, to);
          });
    }
    if (ctx->needs_input_grad(1))
      of_weight = FoldedWeightGradient(cells, grads[0], weight, at::kFloat);
    if (ctx->needs_input_grad(2)) of_bias = grads[0].sum(at::IntArrayRef({0, 2, 3, 4}));
    return {of_grid, of_weight, of_bias, at::Tensor()};
  }
};

struct UpConvUnfoldedFunction : Function<UpConvUnfoldedFunction> {
  static at::Tensor forward(AutogradContext* ctx, const at::Tensor& x, const at::Tensor& weight) {
    ctx->save_for_backward({x, weight});
    const CellConvShape s{x.size(0), x.size(2) + 1, 8 * weight.size(1), weight.size(0)};
    return ConvolveTransposedTaken(s, x, weight, [&](std::int64_t, const float* cells, float* to) {
      UnfoldCells(cells, static_cast<int>(2 * s.h - 2), static_cast<int>(s.in / 8), to);
    });
  }
  static variable_list backward(AutogradContext* ctx, variable_list grads) {
    const variable_list saved = ctx->get_saved_variables();
    const at::Tensor &x = saved[0], &weight = saved[1];
    const CellConvShape s = ShapeOfGrid(grads[0], weight);
    const at::Tensor g = grads[0].contiguous(kChannelsLast);
    const at::Tensor cells = at::empty({s.count, s.in, s.h, s.h, s.h}, g.options(), kChannelsLast);
    const float* first = g.data_ptr<float>();
    const std::int64_t size = g.numel() / s.count;
    const auto fill = [&](std::int64_t i, float* to) {
      FoldNodes(first + i * size, static_cast<int>(g.size(2)), static_cast<int>(g.size(1)), to);
    };
    const at::Tensor of_x = ConvolveFilled(s, fill, cells, weight, {});
    return {of_x, FoldedWeightGradient(cells, x, weight, at::kFloat)};
  }
};

}  // namespace

torch::Tensor DownConvLeaky(const torch::Tensor& grid, double leak, const torch::Tensor& weight,
                            const torch::Tensor& bias, at::ScalarType compute) {
  if (!PassesSampleBySample(grid, ShapeOfGrid(grid, weight), weight, compute)) {
    return DownConv(FoldLeaky(grid, leak), weight, bias, compute);
  }
  return DownConvLeakyFunction::apply(grid, weight, bias, leak);
}

torch::Tensor UpConvUnfolded(const torch::Tensor& x, const torch::Tensor& weight,
                             at::ScalarType compute) {
  const CellConvShape s{x.size(0), x.size(2) + 1, 8 * weight.size(1), weight.size(0)};
  if (!PassesSampleBySample(x, s, weight, compute)) return Unfold(UpConv(x, weight, compute));
  return UpConvUnfoldedFunction::apply(x, weight);
}

}  // namespace antigrasp
