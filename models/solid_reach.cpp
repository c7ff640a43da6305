#include "antigrasp/models/solid_reach.h"

#include <ATen/ATen.h>

namespace antigrasp {
namespace {

// Of the section at one end, in the directions of the cube's axes as seen by the part (|u|, |v|):
// rounded by the larger of its corners and the fillet, drawn in by the fillet.
at::Tensor SectionReach(const at::Tensor& sides, const SolidForm& form, const at::Tensor& u,
                        const at::Tensor& v) {
  const at::Tensor a = sides.narrow(2, 0, 1), b = sides.narrow(2, 1, 1);
  const at::Tensor corner = at::maximum(form.round * at::minimum(a, b), form.fillet);
  const at::Tensor along = (u.square() + v.square()).clamp_min(1e-12).sqrt();
  return (a - corner) * u + (b - corner) * v + (corner - form.fillet) * along;
}

}  // namespace

SolidReach ReachOf(const SolidForm& form) {
  const at::Tensor u = form.axes.select(2, 0).abs(), v = form.axes.select(2, 1).abs();
  const at::Tensor sides = form.half.narrow(2, 0, 2), length = form.half.narrow(2, 2, 1);
  const at::Tensor widening = form.slope * length;
  const at::Tensor upper = SectionReach(sides + widening, form, u, v);
  const at::Tensor lower = SectionReach(sides - widening, form, u, v);
  const at::Tensor w = (length - form.fillet) * form.axes.select(2, 2);
  return {at::maximum(upper + w, lower - w) + form.fillet,
          at::maximum(upper - w, lower + w) + form.fillet};
}

}  // namespace antigrasp
