#include "antigrasp/models/folding.h"

#include <ATen/ATen.h>
#include <torch/csrc/autograd/custom_function.h>

#include <algorithm>

#include "antigrasp/core/pieces.h"
#include "antigrasp/models/fold_cells.h"

namespace antigrasp {
namespace {

using torch::autograd::AutogradContext;
using torch::autograd::Function;
using torch::autograd::variable_list;

// The memory moves take float on the CPU; every other tensor goes through strided copies.
bool HasMoves(const at::Tensor& x) {
  return x.device().is_cpu() && x.scalar_type() == at::kFloat && x.numel() > 0;
}

// Both directions of folding keep the ring here: [N, 8 C, h, h, h] <-> [N, C, 2h, 2h, 2h].
at::Tensor CellsToNodes(const at::Tensor& folded) {
  const std::int64_t channels = folded.size(1) / 8, h = folded.size(2);
  return folded.reshape({-1, 2, 2, 2, channels, h, h, h})
      .permute({0, 4, 5, 1, 6, 2, 7, 3})
      .reshape({-1, channels, 2 * h, 2 * h, 2 * h});
}
at::Tensor NodesToCells(const at::Tensor& nodes) {
  const std::int64_t channels = nodes.size(1), h = nodes.size(2) / 2;
  return nodes.reshape({-1, channels, h, 2, h, 2, h, 2})
      .permute({0, 3, 5, 7, 1, 2, 4, 6})
      .reshape({-1, 8 * channels, h, h, h});
}

at::Tensor AddRing(const at::Tensor& x) { return at::constant_pad_nd(x, {1, 1, 1, 1, 1, 1}); }
at::Tensor DropRing(const at::Tensor& x) {
  const std::int64_t end = x.size(2) - 1;
  return x.slice(2, 1, end).slice(3, 1, end).slice(4, 1, end).contiguous();
}

// A new tensor of this shape, each sample of it made by move(sample of source, sample of result).
template <typename Move>
at::Tensor MoveSamples(const at::Tensor& source, at::IntArrayRef shape, const Move& move) {
  const at::Tensor from = source.contiguous(kChannelsLast);
  at::Tensor result = at::empty(shape, source.options(), kChannelsLast);
  const std::int64_t from_size = from.numel() / shape[0], to_size = result.numel() / shape[0];
  const float* in = from.data_ptr<float>();
  float* out = result.data_ptr<float>();
  ForPieces(shape[0], [&](std::int64_t i) { move(in + i * from_size, out + i * to_size); });
  return result;
}

at::Tensor FoldValues(const at::Tensor& grid) {
  if (!HasMoves(grid)) return NodesToCells(AddRing(grid));
  const auto c = static_cast<int>(grid.size(1)), s = static_cast<int>(grid.size(2));
  const std::int64_t h = s / 2 + 1;
  return MoveSamples(grid, {grid.size(0), 8 * c, h, h, h},
                     [=](const float* from, float* to) { FoldNodes(from, s, c, to); });
}

at::Tensor UnfoldValues(const at::Tensor& folded) {
  if (!HasMoves(folded)) return DropRing(CellsToNodes(folded));
  const auto c = static_cast<int>(folded.size(1) / 8), s = static_cast<int>(2 * folded.size(2) - 2);
  return MoveSamples(folded, {folded.size(0), c, s, s, s},
                     [=](const float* from, float* to) { UnfoldCells(from, s, c, to); });
}

at::Tensor BlurValues(const at::Tensor& folded) {
  if (!HasMoves(folded)) {
    // 1/4, 1/2, 1/4, made on the device: nothing is copied there while a step is recorded.
    const at::Tensor taps = 0.5 - 0.25 * at::arange(-1, 2, folded.options()).abs();
    const at::Tensor kernel = taps.view({3, 1, 1}) * taps.view({3, 1}) * taps;
    return NodesToCells(at::conv3d(CellsToNodes(folded), kernel.view({1, 1, 3, 3, 3}), {}, 1, 1));
  }
  const auto s = static_cast<int>(2 * folded.size(2) - 2);
  return MoveSamples(folded, folded.sizes(),
                     [s](const float* from, float* to) { BlurCells(from, s, to); });
}

at::Tensor WithoutRing(const at::Tensor& folded) {
  if (!HasMoves(folded)) return NodesToCells(AddRing(DropRing(CellsToNodes(folded))));
  const std::int64_t size = folded.numel() / folded.size(0);
  const auto s = static_cast<int>(2 * folded.size(2) - 2);
  return MoveSamples(folded, folded.sizes(), [size, s](const float* from, float* to) {
    std::copy(from, from + size, to);
    ClearRing(s, to);
  });
}

struct FoldFunction : Function<FoldFunction> {
  static at::Tensor forward(AutogradContext*, const at::Tensor& grid) { return FoldValues(grid); }
  static variable_list backward(AutogradContext*, variable_list grads) {
    return {UnfoldValues(grads[0])};
  }
};

struct FoldLeakyFunction : Function<FoldLeakyFunction> {
  static at::Tensor forward(AutogradContext* ctx, const at::Tensor& grid, double leak) {
    const auto c = static_cast<int>(grid.size(1)), s = static_cast<int>(grid.size(2));
    const std::int64_t h = s / 2 + 1;
    const at::Tensor cells =
        MoveSamples(grid, {grid.size(0), 8 * c, h, h, h},
                    [=, slope = static_cast<float>(leak)](const float* from, float* to) {
                      FoldLeakyNodes(from, s, c, slope, to);
                    });
    ctx->save_for_backward({cells});
    ctx->saved_data["leak"] = leak;
    return cells;
  }
  static variable_list backward(AutogradContext* ctx, variable_list grads) {
    const at::Tensor cells = ctx->get_saved_variables()[0];
    const auto leak = static_cast<float>(ctx->saved_data["leak"].toDouble());
    const auto c = static_cast<int>(cells.size(1) / 8), s = static_cast<int>(2 * cells.size(2) - 2);
    const float* first = cells.data_ptr<float>();
    const at::Tensor slopes = grads[0].contiguous(kChannelsLast);
    const float* first_slope = slopes.data_ptr<float>();
    return {MoveSamples(slopes, {slopes.size(0), c, s, s, s},
                        [=](const float* from, float* to) {
                          UnfoldLeakySlopes(from, first + (from - first_slope), s, c, leak, to);
                        }),
            at::Tensor()};
  }
};

struct UnfoldFunction : Function<UnfoldFunction> {
  static at::Tensor forward(AutogradContext*, const at::Tensor& folded) {
    return UnfoldValues(folded);
  }
  static variable_list backward(AutogradContext*, variable_list grads) {
    return {FoldValues(grads[0])};
  }
};

// The blur is a symmetric matrix B and clearing a projection P: forward P B, backward B P.
struct BlurAndClearRingFunction : Function<BlurAndClearRingFunction> {
  static at::Tensor forward(AutogradContext* ctx, const at::Tensor& folded, bool blur) {
    ctx->saved_data["blur"] = blur;
    return WithoutRing(blur ? BlurValues(folded) : folded);
  }
  static variable_list backward(AutogradContext* ctx, variable_list grads) {
    const at::Tensor grad = WithoutRing(grads[0]);
    return {ctx->saved_data["blur"].toBool() ? BlurValues(grad) : grad, at::Tensor()};
  }
};

// I - gain L with the Laplacian of a grid that ends: a symmetric matrix.
at::Tensor EmphasizeValues(const at::Tensor& folded, double gain) {
  if (HasMoves(folded) && folded.size(1) == 8) {
    const auto s = static_cast<int>(2 * folded.size(2) - 2);
    return MoveSamples(folded, folded.sizes(),
                       [s, g = static_cast<float>(gain)](const float* from, float* to) {
                         EmphasizeNodes(from, s, g, to);
                       });
  }
  const at::Tensor x = UnfoldValues(folded);
  at::Tensor result = x.clone();
  for (std::int64_t axis = 2; axis < 5; ++axis) {
    const std::int64_t s = x.size(axis);
    const at::Tensor step = at::sub(x.slice(axis, 1, s), x.slice(axis, 0, s - 1)).mul_(gain);
    result.slice(axis, 0, s - 1).sub_(step);
    result.slice(axis, 1, s).add_(step);
  }
  return FoldValues(result);
}

struct EmphasizeFunction : Function<EmphasizeFunction> {
  static at::Tensor forward(AutogradContext* ctx, const at::Tensor& folded, double gain) {
    ctx->saved_data["gain"] = gain;
    return EmphasizeValues(folded, gain);
  }
  static variable_list backward(AutogradContext* ctx, variable_list grads) {
    return {EmphasizeValues(grads[0], ctx->saved_data["gain"].toDouble()), at::Tensor()};
  }
};

}  // namespace

torch::Tensor Fold(const torch::Tensor& grid) { return FoldFunction::apply(grid); }
torch::Tensor Unfold(const torch::Tensor& folded) { return UnfoldFunction::apply(folded); }

torch::Tensor FoldLeaky(const torch::Tensor& grid, double leak) {
  if (!HasMoves(grid)) return Fold(at::leaky_relu(grid, leak));
  return FoldLeakyFunction::apply(grid, leak);
}

torch::Tensor BlurAndClearRing(const torch::Tensor& folded, bool blur) {
  return BlurAndClearRingFunction::apply(folded, blur);
}

torch::Tensor EmphasizeEdges(const torch::Tensor& folded, double gain) {
  return gain > 0.0 ? EmphasizeFunction::apply(folded, gain) : folded;
}

}  // namespace antigrasp
