#include "antigrasp/models/elementwise.h"

#include <torch/csrc/autograd/custom_function.h>

#include <algorithm>

#include "antigrasp/models/slices.h"

namespace antigrasp {
namespace {

using torch::autograd::AutogradContext;
using torch::autograd::Function;
using torch::autograd::variable_list;

struct TanhFunction : Function<TanhFunction> {
  static at::Tensor forward(AutogradContext* ctx, const at::Tensor& x) {
    at::Tensor y = at::empty_like(x);
    OnSlices<2>({y, x}, [](auto s) { at::tanh_out(s[0], s[1]); });
    ctx->save_for_backward({y});
    return y;
  }
  static variable_list backward(AutogradContext* ctx, variable_list grads) {
    const at::Tensor y = ctx->get_saved_variables()[0];
    at::Tensor result = at::empty_like(y);
    OnSlices<3>({result, grads[0], y}, [](auto s) { at::tanh_backward_out(s[0], s[1], s[2]); });
    return {result};
  }
};

struct AddNumberFunction : Function<AddNumberFunction> {
  static at::Tensor forward(AutogradContext*, const at::Tensor& x, const at::Tensor& number) {
    at::Tensor result = at::empty_like(x);
    OnSlices<2>({result, x}, [&](auto s) { at::add_out(s[0], s[1], number); });
    return result;
  }
  static variable_list backward(AutogradContext*, variable_list grads) {
    std::vector<std::int64_t> all(static_cast<std::size_t>(grads[0].dim()));
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<std::int64_t>(i);
    return {grads[0], grads[0].sum(all, /*keepdim=*/true).view({1})};
  }
};

// rows += left x right, rows [m, n].
void AddOuter(const at::Tensor& left, const at::Tensor& right, const at::Tensor& rows) {
  const std::int64_t at_a_time = std::max<std::int64_t>(1, kSlice / right.numel());
  ForRanges(rows.size(0), at_a_time, [&](std::int64_t begin, std::int64_t end) {
    const at::AutoDispatchBelowADInplaceOrView no_gradients;
    rows.slice(0, begin, end).add_(left.slice(0, begin, end).view({-1, 1}) * right);
  });
}

struct DivideBySigmaFunction : Function<DivideBySigmaFunction> {
  static at::Tensor forward(AutogradContext* ctx, const at::Tensor& weight, const at::Tensor& u,
                            const at::Tensor& v, double least) {
    const at::Tensor product = u.dot(weight.flatten(1).mv(v));
    const at::Tensor sigma = product.clamp_min(least);
    ctx->save_for_backward({weight, u, v, sigma});
    ctx->saved_data["moves"] = product.item<float>() >= static_cast<float>(least);
    at::Tensor result = at::empty_like(weight);
    OnSlices<2>({result, weight}, [&](auto s) { at::div_out(s[0], s[1], sigma); });
    return result;
  }
  // LibTorch's gradients of the operations above, in its order.
  static variable_list backward(AutogradContext* ctx, variable_list grads) {
    const variable_list saved = ctx->get_saved_variables();
    const at::Tensor &weight = saved[0], &u = saved[1], &v = saved[2], &sigma = saved[3];
    const at::Tensor slope = grads[0].contiguous();
    at::Tensor result = at::empty_like(weight, at::MemoryFormat::Contiguous);
    at::Tensor of_sigma = at::empty_like(result);
    OnSlices<4>({result, of_sigma, slope, weight}, [&](auto s) {
      at::div_out(s[0], s[2], sigma);
      at::mul_out(s[1], s[2].neg(), s[3].div(sigma).div_(sigma));
    });
    if (ctx->saved_data["moves"].toBool()) AddOuter(of_sigma.sum() * u, v, result.flatten(1));
    return {result, at::Tensor(), at::Tensor(), at::Tensor()};
  }
};

}  // namespace

torch::Tensor Tanh(const torch::Tensor& x) { return TanhFunction::apply(x); }

torch::Tensor AddNumber(const torch::Tensor& x, const torch::Tensor& number) {
  return AddNumberFunction::apply(x, number);
}

torch::Tensor DivideBySigma(const torch::Tensor& weight, const torch::Tensor& u,
                            const torch::Tensor& v, double least) {
  return DivideBySigmaFunction::apply(weight, u, v, least);
}

torch::Tensor Stacked(const torch::Tensor& first, const torch::Tensor& second) {
  std::vector<std::int64_t> sizes = first.sizes().vec();
  sizes[0] += second.size(0);
  const at::Tensor result =
      at::empty(sizes, first.options(), first.suggest_memory_format()).detach();
  const at::Tensor first_part = result.slice(0, 0, first.size(0));
  const at::Tensor second_part = result.slice(0, first.size(0));
  OnSlices<2>({first_part, first}, [](auto s) { s[0].copy_(s[1]); });
  OnSlices<2>({second_part, second}, [](auto s) { s[0].copy_(s[1]); });
  return result;
}

}  // namespace antigrasp
