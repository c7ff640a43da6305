#include "antigrasp/models/solid_field.h"

#include <ATen/ATen.h>
#include <torch/csrc/autograd/custom_function.h>

#include "antigrasp/core/check.h"
#include "antigrasp/core/pieces.h"
#include "antigrasp/models/solid_rows.h"
#include "antigrasp/models/solid_terms.h"

namespace antigrasp {
namespace {

using torch::autograd::AutogradContext;
using torch::autograd::variable_list;

class UnionFunction : public torch::autograd::Function<UnionFunction> {
 public:
  static at::Tensor forward(AutogradContext* context, const at::Tensor& parts, std::int64_t r) {
    const at::Tensor values = at::empty({parts.size(0), 1, r, r, r}, parts.options());
    const at::Tensor nearest = at::empty(values.sizes(), parts.options().dtype(at::kByte));
    auto* value = values.data_ptr<float>();
    auto* which = nearest.data_ptr<std::uint8_t>();
    ForSolids(parts, r, [&](std::int64_t i, const solid::Solid& solid) {
      solid::Union(solid, value + i * r * r * r, which + i * r * r * r);
    });
    context->save_for_backward({parts, nearest});
    return values;
  }

  static variable_list backward(AutogradContext* context, const variable_list& gradients) {
    const auto saved = context->get_saved_variables();
    const at::Tensor &parts = saved[0], &nearest = saved[1];
    const at::Tensor by_value = gradients[0].contiguous(), gradient = at::zeros_like(parts);
    const auto* given = by_value.data_ptr<float>();
    const auto* which = nearest.data_ptr<std::uint8_t>();
    auto* sums = gradient.data_ptr<float>();
    const std::int64_t r = nearest.size(2), row = parts.size(1) * kPartColumns;
    ForSolids(parts, r, [&](std::int64_t i, const solid::Solid& solid) {
      solid::AddUnionGradient(solid, given + i * r * r * r, which + i * r * r * r, sums + i * row);
    });
    return {gradient, at::Tensor()};
  }

 private:
  // Calls visit(i, solid) for each of the batch, each in one thread.
  template <typename Visit>
  static void ForSolids(const at::Tensor& parts, std::int64_t r, const Visit& visit) {
    const at::Tensor coordinates = NodeCoordinates(r, parts.options());
    const auto *first = parts.data_ptr<float>(), *x = coordinates.data_ptr<float>();
    const std::int64_t count = parts.size(1);
    ForPieces(parts.size(0), [&](std::int64_t i) {
      visit(i, solid::Solid{first + i * count * kPartColumns, count, x, r});
    });
  }
};

}  // namespace

at::Tensor SolidFieldByOperations(const at::Tensor& parts, std::int64_t resolution) {
  const auto column = [&](int c) {
    return parts.select(2, c).unsqueeze(-1).unsqueeze(-1).unsqueeze(-1);
  };
  const at::Tensor x = NodeCoordinates(resolution, parts.options());
  const at::Tensor y = x.view({-1, 1}), z = x.view({-1, 1, 1});
  const auto along = [&](int axis) {
    return column(3 * axis) * x + column(3 * axis + 1) * y + column(3 * axis + 2) * z -
           column(kPartCentre + axis);
  };
  const auto cut = [](const at::Tensor& t) { return t.clamp_min(0.0); };
  // Root of squares without a gradient where both are 0.
  const auto length = [&](const at::Tensor& a, const at::Tensor& b) {
    return (cut(a).square() + cut(b).square()).clamp_min(1e-18).sqrt();
  };
  const at::Tensor w = along(2);
  const at::Tensor a = column(kPartHalf) + column(kPartLean) * w;
  const at::Tensor b = column(kPartHalf + 1) + column(kPartLean + 1) * w;
  const at::Tensor r = column(kPartRound) * at::minimum(a, b);
  const at::Tensor du = along(0).abs() - a + r, dv = along(1).abs() - b + r;
  const at::Tensor section = length(du, dv) + at::maximum(du, dv).clamp_max(0.0) - r;
  const at::Tensor fillet = column(kPartFillet);
  const at::Tensor ds = column(kPartNarrow) * section + fillet;
  const at::Tensor dw = w.abs() - column(kPartHalf + 2) + fillet;
  const at::Tensor distance = length(ds, dw) + at::maximum(ds, dw).clamp_max(0.0) - fillet;
  return std::get<0>((-distance).max(1, /*keepdim=*/true));  // the first of equals
}

at::Tensor SolidField(const at::Tensor& parts, std::int64_t resolution) {
  AG_CHECK(parts.dim() == 3 && parts.size(1) > 0 && parts.size(1) <= kMostParts &&
               parts.size(2) == kPartColumns && resolution % solid::kLanes == 0,
           "parts [N, M, 20] and a grid of whole rows");
  if (!parts.device().is_cpu() || parts.scalar_type() != at::kFloat) {
    return SolidFieldByOperations(parts, resolution);
  }
  return UnionFunction::apply(parts.contiguous(), resolution);
}

}  // namespace antigrasp
