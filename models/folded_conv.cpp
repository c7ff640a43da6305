#include <ATen/ATen.h>
#include <torch/csrc/autograd/custom_function.h>

#include <algorithm>
#include <vector>

#include "antigrasp/core/pieces.h"
#include "antigrasp/models/cell_conv.h"
#include "antigrasp/models/folded_conv.h"
#include "antigrasp/models/folding.h"
#include "antigrasp/models/libtorch.h"
#include "antigrasp/models/winograd_conv.h"

// A kernel of 4 with stride 2 on nodes is a kernel of 2 with stride 1 on cells: tap 2 s + p of an
// axis links the phase p of a cell to the value s cells before it.
namespace antigrasp {
namespace {

using torch::autograd::AutogradContext;
using torch::autograd::Function;
using torch::autograd::variable_list;

constexpr std::int64_t kTaps = 64, kBlock = 16;

// Number s of the folded kernel's tap and phase p of tap t of 4^3.
struct TapAndPhase {
  std::int64_t s, p;
};
TapAndPhase SplitTap(std::int64_t t) {
  const std::int64_t z = t >> 4, y = t >> 2 & 3, x = t & 3;
  return {4 * (z >> 1) + 2 * (y >> 1) + (x >> 1), 4 * (z & 1) + 2 * (y & 1) + (x & 1)};
}

// [a, b, 4, 4, 4] -> [a, 8 b, 2, 2, 2], for at::conv3d.
at::Tensor FoldKernel(const at::Tensor& weight) {
  return weight.reshape({weight.size(0), weight.size(1), 2, 2, 2, 2, 2, 2})
      .permute({0, 3, 5, 7, 1, 2, 4, 6})
      .reshape({weight.size(0), 8 * weight.size(1), 2, 2, 2});
}
at::Tensor UnfoldKernel(const at::Tensor& kernel) {
  const std::int64_t b = kernel.size(1) / 8;
  return kernel.reshape({kernel.size(0), 2, 2, 2, b, 2, 2, 2})
      .permute({0, 4, 5, 1, 6, 2, 7, 3})
      .reshape({kernel.size(0), b, 4, 4, 4});
}

// The same for cell_conv.h: panels of its outputs a, or of its inputs 8 b.
std::vector<float> Panels(const at::Tensor& weight, bool of_outputs) {
  const at::Tensor source = weight.contiguous();
  const float* values = source.data_ptr<float>();
  const std::int64_t a = weight.size(0), b = weight.size(1);
  const std::int64_t width = of_outputs ? a : 8 * b, depth = of_outputs ? 8 * b : a;
  std::vector<float> panels(a * b * kTaps);
  ForRanges(a, 8, [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t o = begin; o < end; ++o) {
      for (std::int64_t t = 0; t < kTaps; ++t) {
        const auto [s, p] = SplitTap(t);
        for (std::int64_t j = 0; j < b; ++j) {
          const std::int64_t i = p * b + j, column = of_outputs ? o : i, row = of_outputs ? i : o;
          const std::int64_t first = column / kBlock * kBlock;
          panels[first * 8 * depth + (s * depth + row) * std::min(kBlock, width - first) + column -
                 first] = values[(o * b + j) * kTaps + t];
        }
      }
    }
  });
  return panels;
}

// What LibTorch's convolutions take. Tensor cores want the channels side by side.
at::Tensor Operand(const at::Tensor& x, at::ScalarType compute) {
  return compute == at::kFloat ? x : x.to(x.options().dtype(compute), false, false, kChannelsLast);
}

// at::convolution_backward of x -> conv3d(x, kernel): of its input or of its kernel.
at::Tensor ConvGradient(const at::Tensor& grad_output, const at::Tensor& input,
                        const at::Tensor& kernel, bool of_input, at::ScalarType compute) {
  auto gradients =
      at::convolution_backward(Operand(grad_output, compute), Operand(input, compute),
                               Operand(kernel, compute), kNoBiasSizes, {1, 1, 1}, {0, 0, 0},
                               {1, 1, 1}, false, {0, 0, 0}, 1, {of_input, !of_input, false});
  return (of_input ? std::get<0>(gradients) : std::get<1>(gradients)).to(grad_output.scalar_type());
}

// cells [N, 8 b, h, h, h], weight [a, b, 4, 4, 4] -> [N, a, h - 1, h - 1, h - 1].
at::Tensor Convolve(const at::Tensor& cells, const at::Tensor& weight, const at::Tensor& bias,
                    at::ScalarType compute) {
  if (!TakesCellConv(cells, weight, compute)) {
    const at::Tensor x = Operand(cells, compute);
    const at::Tensor sums = at::conv3d(x, Operand(FoldKernel(weight), compute),
                                       bias.defined() ? bias.to(x.scalar_type()) : bias);
    return sums.to(cells.scalar_type());
  }
  const at::Tensor x = cells.contiguous(kChannelsLast);
  const at::Tensor b = bias.defined() ? bias.contiguous() : bias;
  const CellConvShape shape{x.size(0), x.size(2), x.size(1), weight.size(0)};
  const std::int64_t g = shape.h - 1;
  const float* bias_values = b.defined() ? b.data_ptr<float>() : nullptr;
  at::Tensor result = at::empty({shape.count, shape.out, g, g, g}, x.options(), kChannelsLast);
  if (SuitsWinograd(shape)) {
    WinogradConv(shape, x.data_ptr<float>(), weight.contiguous().data_ptr<float>(), bias_values,
                 result.data_ptr<float>());
  } else {
    CellConv(shape, x.data_ptr<float>(), Panels(weight, true).data(), bias_values,
             result.data_ptr<float>());
  }
  return result;
}

// Its transpose: values [N, a, g, g, g] -> [N, 8 b, g + 1, g + 1, g + 1].
at::Tensor ConvolveTransposed(const at::Tensor& values, const at::Tensor& weight,
                              at::ScalarType compute) {
  const std::int64_t n = values.size(0), h = values.size(2) + 1, in = 8 * weight.size(1);
  at::Tensor result = at::empty({n, in, h, h, h}, values.options(), kChannelsLast);
  if (!TakesCellConv(values, weight, compute)) {
    return ConvGradient(values, result, FoldKernel(weight), true,
                        compute);  // looks at its shape only
  }
  const CellConvShape shape{n, h, in, weight.size(0)};
  const at::Tensor x = values.contiguous(kChannelsLast);
  if (SuitsWinograd(shape)) {
    WinogradConvTranspose(shape, x.data_ptr<float>(), weight.contiguous().data_ptr<float>(),
                          result.data_ptr<float>());
  } else {
    CellConvTranspose(shape, x.data_ptr<float>(), Panels(weight, false).data(),
                      result.data_ptr<float>());
  }
  return result;
}

}  // namespace

bool TakesCellConv(const at::Tensor& x, const at::Tensor& weight, at::ScalarType compute) {
  return compute == at::kFloat && HasCellConv() && x.device().is_cpu() &&
         x.scalar_type() == at::kFloat && x.numel() > 0 && weight.size(0) % 8 == 0;
}

at::Tensor FoldedWeightGradient(const at::Tensor& cells, const at::Tensor& values,
                                const at::Tensor& weight, at::ScalarType compute) {
  if (!TakesCellConv(cells, weight, compute)) {
    return UnfoldKernel(ConvGradient(values, cells, FoldKernel(weight), false, compute));
  }
  const CellConvShape shape{cells.size(0), cells.size(2), cells.size(1), weight.size(0)};
  const at::Tensor x = cells.contiguous(kChannelsLast), y = values.contiguous(kChannelsLast);
  at::Tensor result = at::empty_like(weight, at::MemoryFormat::Contiguous);
  if (SuitsWinograd(shape)) {
    WinogradConvWeightGradient(shape, x.data_ptr<float>(), y.data_ptr<float>(),
                               result.data_ptr<float>());
    return result;
  }
  std::vector<float> gradient(8 * shape.in * shape.out);
  CellConvWeightGradient(shape, x.data_ptr<float>(), y.data_ptr<float>(), gradient.data());
  float* to = result.data_ptr<float>();
  const std::int64_t b = weight.size(1);
  for (std::int64_t t = 0; t < kTaps; ++t) {
    const auto [s, p] = SplitTap(t);
    for (std::int64_t j = 0; j < b; ++j) {
      const float* row = gradient.data() + (s * shape.in + p * b + j) * shape.out;
      for (std::int64_t o = 0; o < shape.out; ++o) to[(o * b + j) * kTaps + t] = row[o];
    }
  }
  return result;
}

namespace {

at::ScalarType SavedType(const AutogradContext& ctx) {
  return static_cast<at::ScalarType>(ctx.saved_data.at("compute").toInt());
}

struct DownConvFunction : Function<DownConvFunction> {
  static at::Tensor forward(AutogradContext* ctx, const at::Tensor& cells, const at::Tensor& weight,
                            const at::Tensor& bias, at::ScalarType compute) {
    ctx->save_for_backward({cells, weight});
    ctx->saved_data["compute"] = static_cast<std::int64_t>(compute);
    return Convolve(cells, weight, bias, compute);
  }
  static variable_list backward(AutogradContext* ctx, variable_list grads) {
    const variable_list saved = ctx->get_saved_variables();
    const at::ScalarType compute = SavedType(*ctx);
    at::Tensor input, weight, bias;
    if (ctx->needs_input_grad(0)) input = ConvolveTransposed(grads[0], saved[1], compute);
    if (ctx->needs_input_grad(1))
      weight = FoldedWeightGradient(saved[0], grads[0], saved[1], compute);
    if (ctx->needs_input_grad(2)) bias = grads[0].sum(at::IntArrayRef({0, 2, 3, 4}));
    return {input, weight, bias, at::Tensor()};
  }
};

struct UpConvFunction : Function<UpConvFunction> {
  static at::Tensor forward(AutogradContext* ctx, const at::Tensor& x, const at::Tensor& weight,
                            at::ScalarType compute) {
    ctx->save_for_backward({x, weight});
    ctx->saved_data["compute"] = static_cast<std::int64_t>(compute);
    return ConvolveTransposed(x, weight, compute);
  }
  static variable_list backward(AutogradContext* ctx, variable_list grads) {
    const variable_list saved = ctx->get_saved_variables();
    const at::ScalarType compute = SavedType(*ctx);
    return {Convolve(grads[0], saved[1], {}, compute),
            FoldedWeightGradient(grads[0], saved[0], saved[1], compute), at::Tensor()};
  }
};

}  // namespace

torch::Tensor DownConv(const torch::Tensor& folded, const torch::Tensor& weight,
                       const torch::Tensor& bias, at::ScalarType compute) {
  return DownConvFunction::apply(folded, weight, bias, compute);
}

torch::Tensor UpConv(const torch::Tensor& x, const torch::Tensor& weight, at::ScalarType compute) {
  return UpConvFunction::apply(x, weight, compute);
}

}  // namespace antigrasp
