#include "antigrasp/models/folding.h"

#include <ATen/ATen.h>
#include <ATen/Parallel.h>
#include <torch/csrc/autograd/custom_function.h>

#include "antigrasp/models/fold_plane.h"

namespace antigrasp {
namespace {

using torch::autograd::AutogradContext;
using torch::autograd::Function;
using torch::autograd::variable_list;

constexpr std::int64_t kCells = 17;

// The plane kernels take float on the CPU; every other tensor goes through strided copies.
bool HasPlaneKernel(const at::Tensor& x) {
  return x.device().is_cpu() && x.scalar_type() == at::kFloat;
}

// Both directions of folding keep the ring here: [N, 8 C, h, h, h] <-> [N, C, 2h, 2h, 2h].
at::Tensor CellsToNodes(const at::Tensor& folded) {
  const std::int64_t channels = folded.size(1) / 8, h = folded.size(2);
  return folded.reshape({-1, channels, 2, 2, 2, h, h, h})
      .permute({0, 1, 5, 2, 6, 3, 7, 4})
      .reshape({-1, channels, 2 * h, 2 * h, 2 * h});
}
at::Tensor NodesToCells(const at::Tensor& nodes) {
  const std::int64_t channels = nodes.size(1), h = nodes.size(2) / 2;
  return nodes.reshape({-1, channels, h, 2, h, 2, h, 2})
      .permute({0, 1, 3, 5, 7, 2, 4, 6})
      .reshape({-1, 8 * channels, h, h, h});
}

at::Tensor AddRing(const at::Tensor& x) { return at::constant_pad_nd(x, {1, 1, 1, 1, 1, 1}); }
at::Tensor DropRing(const at::Tensor& x) {
  const std::int64_t end = x.size(2) - 1;
  return x.slice(2, 1, end).slice(3, 1, end).slice(4, 1, end).contiguous();
}

// Runs kernel(source plane, target plane) for each channel of each sample.
template <typename Kernel>
void ForPlanes(const at::Tensor& source, const at::Tensor& target, std::int64_t planes,
               const Kernel& kernel) {
  const float* from = source.data_ptr<float>();
  float* to = target.data_ptr<float>();
  const std::int64_t from_size = source.numel() / planes, to_size = target.numel() / planes;
  at::parallel_for(0, planes, 1, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i < end; ++i) {
      kernel(from + i * from_size, to + i * to_size);
    }
  });
}

at::Tensor FoldValues(const at::Tensor& grid) {
  if (!HasPlaneKernel(grid) || grid.numel() == 0) {
    return NodesToCells(AddRing(grid));
  }
  const std::int64_t s = grid.size(2), h = s / 2 + 1;
  at::Tensor result = at::empty({grid.size(0), 8 * grid.size(1), h, h, h}, grid.options());
  ForPlanes(grid.contiguous(), result, grid.size(0) * grid.size(1),
            [s](const float* from, float* to) { FoldPlane(from, static_cast<int>(s), to); });
  return result;
}

at::Tensor UnfoldValues(const at::Tensor& folded) {
  if (!HasPlaneKernel(folded) || folded.numel() == 0) {
    return DropRing(CellsToNodes(folded));
  }
  const std::int64_t channels = folded.size(1) / 8, s = 2 * folded.size(2) - 2;
  at::Tensor result = at::empty({folded.size(0), channels, s, s, s}, folded.options());
  ForPlanes(folded.contiguous(), result, folded.size(0) * channels,
            [s](const float* from, float* to) { UnfoldPlane(from, static_cast<int>(s), to); });
  return result;
}

at::Tensor BlurValues(const at::Tensor& folded) {
  if (!HasPlaneKernel(folded) || folded.numel() == 0) {
    const at::Tensor taps = at::tensor({0.25, 0.5, 0.25}, folded.options());
    const at::Tensor kernel = taps.view({3, 1, 1}) * taps.view({3, 1}) * taps;
    return NodesToCells(at::conv3d(CellsToNodes(folded), kernel.view({1, 1, 3, 3, 3}), {}, 1, 1));
  }
  const at::Tensor source = folded.contiguous();
  at::Tensor result = at::empty_like(source);
  ForPlanes(source, result, source.size(0), BlurPlane);
  return result;
}

at::Tensor WithoutRing(const at::Tensor& folded) {
  if (!HasPlaneKernel(folded) || folded.numel() == 0) {
    return NodesToCells(AddRing(DropRing(CellsToNodes(folded))));
  }
  at::Tensor result = folded.clone(at::MemoryFormat::Contiguous);
  ForPlanes(result, result, result.size(0), [](const float*, float* plane) { ClearRing(plane); });
  return result;
}

struct FoldFunction : Function<FoldFunction> {
  static at::Tensor forward(AutogradContext*, const at::Tensor& grid) { return FoldValues(grid); }
  static variable_list backward(AutogradContext*, variable_list grads) {
    return {UnfoldValues(grads[0])};
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

// [a, b, 4, 4, 4] -> [a, 8 b, 2, 2, 2]: tap 2 s + p of an axis links the phase p of a cell to the
// value s cells before it.
at::Tensor FoldKernel(const at::Tensor& weight) {
  return weight.view({weight.size(0), weight.size(1), 2, 2, 2, 2, 2, 2})
      .permute({0, 1, 3, 5, 7, 2, 4, 6})
      .reshape({weight.size(0), 8 * weight.size(1), 2, 2, 2});
}

// Gradient of conv3d(input, kernel), kernel 2, with respect to its input or its kernel.
at::Tensor ConvGradient(const at::Tensor& grad_output, const at::Tensor& input,
                        const at::Tensor& kernel, bool of_input) {
  auto gradients =
      at::convolution_backward(grad_output, input, kernel, c10::nullopt, {1, 1, 1}, {0, 0, 0},
                               {1, 1, 1}, false, {0, 0, 0}, 1, {of_input, !of_input, false});
  return of_input ? std::get<0>(gradients) : std::get<1>(gradients);
}

// The transpose of x -> conv3d(x, kernel): what that convolution calls the gradient of its input.
struct TransposedConvFunction : Function<TransposedConvFunction> {
  static at::Tensor forward(AutogradContext* ctx, const at::Tensor& x, const at::Tensor& kernel) {
    ctx->save_for_backward({x, kernel});
    const std::int64_t h = x.size(2) + 1;
    const at::Tensor shape_only = at::empty({x.size(0), kernel.size(1), h, h, h}, x.options());
    return ConvGradient(x, shape_only, kernel, true);
  }
  static variable_list backward(AutogradContext* ctx, variable_list grads) {
    const variable_list saved = ctx->get_saved_variables();
    return {at::conv3d(grads[0], saved[1]), ConvGradient(saved[0], grads[0], saved[1], false)};
  }
};

}  // namespace

torch::Tensor Fold(const torch::Tensor& grid) { return FoldFunction::apply(grid); }
torch::Tensor Unfold(const torch::Tensor& folded) { return UnfoldFunction::apply(folded); }

torch::Tensor DownConv(const torch::Tensor& folded, const torch::Tensor& weight,
                       const torch::Tensor& bias) {
  return at::conv3d(folded, FoldKernel(weight), bias);
}

torch::Tensor UpConv(const torch::Tensor& x, const torch::Tensor& weight) {
  return TransposedConvFunction::apply(x, FoldKernel(weight));
}

torch::Tensor BlurAndClearRing(const torch::Tensor& folded, bool blur) {
  return BlurAndClearRingFunction::apply(folded, blur);
}

}  // namespace antigrasp
