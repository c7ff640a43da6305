#include "antigrasp/models/turned_field.h"

#include <ATen/ATen.h>
#include <torch/csrc/autograd/custom_function.h>

#include "antigrasp/core/check.h"
#include "antigrasp/core/pieces.h"
#include "antigrasp/models/solid_terms.h"
#include "antigrasp/models/turned_rows.h"

namespace antigrasp {
namespace {

constexpr std::int64_t kMostPoints = 4096, kWholeRows = 16;

class TurnedFunction : public torch::autograd::Function<TurnedFunction> {
 public:
  static at::Tensor forward(torch::autograd::AutogradContext* context, const at::Tensor& outlines,
                            std::int64_t r) {
    const std::int64_t n = outlines.size(0);
    const at::Tensor values = at::empty({n, 1, r, r, r}, outlines.options());
    const at::Tensor distances = at::empty({n, turned::Radii(r), r}, outlines.options());
    const at::Tensor nearest = at::empty(distances.sizes(), outlines.options().dtype(at::kShort));
    auto *value = values.data_ptr<float>(), *distance = distances.data_ptr<float>();
    auto* which = nearest.data_ptr<std::int16_t>();
    const std::int64_t places = turned::Radii(r) * r;
    ForOutlines(outlines, r, [&](std::int64_t i, const turned::Outline& outline) {
      turned::Distances(outline, distance + i * places, which + i * places);
      turned::Spread(distance + i * places, r, value + i * r * r * r);
    });
    context->save_for_backward({outlines, distances, nearest});
    return values;
  }

  static torch::autograd::variable_list backward(torch::autograd::AutogradContext* context,
                                                 const torch::autograd::variable_list& gradients) {
    const auto saved = context->get_saved_variables();
    const at::Tensor &outlines = saved[0], &distances = saved[1], &nearest = saved[2];
    const at::Tensor by_value = gradients[0].contiguous(), gradient = at::zeros_like(outlines);
    const auto *given = by_value.data_ptr<float>(), *distance = distances.data_ptr<float>();
    const auto* which = nearest.data_ptr<std::int16_t>();
    auto* sums = gradient.data_ptr<float>();
    const std::int64_t r = distances.size(2), places = turned::Radii(r) * r;
    ForOutlines(outlines, r, [&](std::int64_t i, const turned::Outline& outline) {
      turned::AddGradient(outline, given + i * r * r * r, distance + i * places, which + i * places,
                          sums + i * 2 * outline.count);
    });
    return {gradient, at::Tensor()};
  }

 private:
  // Calls visit(i, outline) for each of the batch, each in one thread.
  template <typename Visit>
  static void ForOutlines(const at::Tensor& outlines, std::int64_t r, const Visit& visit) {
    const at::Tensor coordinates = NodeCoordinates(r, outlines.options());
    const auto *first = outlines.data_ptr<float>(), *x = coordinates.data_ptr<float>();
    const std::int64_t count = outlines.size(1);
    ForPieces(outlines.size(0), [&](std::int64_t i) {
      visit(i, turned::Outline{first + i * count * 2, count, x, r});
    });
  }
};

}  // namespace

at::Tensor TurnedFieldByOperations(const at::Tensor& outlines, std::int64_t resolution) {
  const at::Tensor x = NodeCoordinates(resolution, outlines.options());
  const at::Tensor squared = (x.square().view({-1, 1}) + x.square()).view({-1, 1, 1});
  const at::Tensor radius = squared.sqrt(), height = x.view({-1, 1});  // [r^2, 1, 1], [r, 1]
  const std::int64_t pieces = outlines.size(1) - 1;
  const auto point = [&](std::int64_t first, std::int64_t axis) {  // [N, 1, 1, pieces]
    return outlines.narrow(1, first, pieces).select(2, axis).view({-1, 1, 1, pieces});
  };
  const at::Tensor along_radius = point(1, 0) - point(0, 0), along_z = point(1, 1) - point(0, 1);
  const at::Tensor from = radius - point(0, 0), up = height - point(0, 1);
  const at::Tensor length = (along_radius.square() + along_z.square()).clamp_min(1e-12);
  const at::Tensor t = ((from * along_radius + up * along_z) / length).clamp(0.0, 1.0);
  const at::Tensor nearest = ((from - t * along_radius).square() + (up - t * along_z).square())
                                 .amin(3)
                                 .clamp_min(1e-18)
                                 .sqrt();
  const at::Tensor spans = (point(0, 1) > height).logical_xor(point(1, 1) > height);
  const at::Tensor slope =
      along_radius / at::where(along_z == 0.0, at::ones_like(along_z), along_z);
  const at::Tensor crossings = spans.logical_and(up * slope > from).sum(3).remainder(2);
  const at::Tensor values = nearest * (2 * crossings - 1);  // [N, r^2, r]
  return values.transpose(1, 2).reshape({-1, 1, resolution, resolution, resolution});
}

at::Tensor TurnedField(const at::Tensor& outlines, std::int64_t resolution) {
  AG_CHECK(outlines.dim() == 3 && outlines.size(1) >= 2 && outlines.size(1) <= kMostPoints &&
               outlines.size(2) == 2 && resolution % kWholeRows == 0,
           "outlines [N, P, 2] and a grid of whole rows");
  if (!outlines.device().is_cpu() || outlines.scalar_type() != at::kFloat) {
    return TurnedFieldByOperations(outlines, resolution);
  }
  return TurnedFunction::apply(outlines.contiguous(), resolution);
}

}  // namespace antigrasp
