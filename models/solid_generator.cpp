#include "antigrasp/models/solid_generator.h"

#include <torch/nn/functional/normalization.h>

#include <cmath>
#include <string>

#include "antigrasp/models/folding.h"
#include "antigrasp/models/largest_piece.h"
#include "antigrasp/models/random_tensor.h"
#include "antigrasp/models/sdf_values.h"
#include "antigrasp/models/solid_field.h"

namespace antigrasp {
namespace {

// What the last layer says of a part; numbers of about 1, any are allowed.
enum Raw {
  kPlace = 0,
  kSize = 3,
  kAxis = 6,
  kSide = 9,
  kGrip = 12,
  kRound = 15,
  kLean = 16,
  kEnds = 18
};
constexpr std::int64_t kRaws = 19;

constexpr int kUnitsPerWidth = 32;
constexpr double kLastGain = 0.7, kLastBias = 0.5;  // deviations of what the last layer begins with

// In units of the cube's side. A part is never thinner than two cells of 32^3: one that is comes
// and goes with where the nodes lie, and its rim is saw teeth.
constexpr double kPlaceScale = 0.25, kSizeScale = 0.18, kLeastHalf = 0.03;
// Of half the side, 0.5: what parts may reach, so that no shape touches the border, and what one
// may fill so that it still has somewhere to go.
constexpr double kRoom = 0.46, kFullest = 0.455;
constexpr double kSteepest = 0.9;  // of the lean that thins an end down to that
// Parts begin as boxes, nearly: a form that were drawn at random would be learnt last, and grafts
// of prisms would stay cones. Leans and the two sides of a section that are nearly nothing and
// nearly equal are so exactly.
constexpr double kFormGain = 0.25;  // of what the last layer begins with
constexpr double kRoundBias = -1.2, kEndsBias = -1.4;
constexpr double kUpright = 0.25, kEqualSides = 0.1;

torch::Tensor Unit(const torch::Tensor& x) {
  return torch::nn::functional::normalize(x, torch::nn::functional::NormalizeFuncOptions().dim(-1));
}

// In [0, 1], both ends included.
torch::Tensor Share(const torch::Tensor& x) {
  return (1.2 * torch::sigmoid(1.5 * x) - 0.1).clamp(0.0, 1.0);
}

// Two of the frame's axes by Gram and Schmidt, near those of the cube: [N, M, 3, 3], rows.
torch::Tensor Axes(const torch::Tensor& first, const torch::Tensor& second) {
  const torch::Tensor cube = torch::eye(3, first.options());
  const torch::Tensor u = Unit(first + cube[0]), side = second + cube[1];
  const torch::Tensor v = Unit(side - (u * side).sum(-1, true) * u);
  return torch::stack({u, v, torch::cross(u, v, -1)}, 2);
}

// By how much half sizes along u, v and w exceed the least; about equal sides are equal.
torch::Tensor Sizes(const torch::Tensor& raw) {
  const torch::Tensor size = 0.5 * raw.clamp(-4.0, 3.0);  // logarithms
  const torch::Tensor u = size.narrow(2, 0, 1);
  const torch::Tensor v = u + torch::softshrink(size.narrow(2, 1, 1), kEqualSides);
  return kSizeScale * torch::cat({u, v, size.narrow(2, 2, 1)}, 2).exp();
}

// How far parts reach from their centres along the cube's axes: [N, M, 3]. `lean`: share of the
// half size by which a section grows to the wider end.
torch::Tensor Reach(const torch::Tensor& half, const torch::Tensor& axes,
                    const torch::Tensor& lean) {
  const torch::Tensor widest =
      torch::cat({half.narrow(2, 0, 2) * (1.0 + lean.abs()), half.narrow(2, 2, 1)}, 2);
  return (axes.abs() * widest.unsqueeze(-1)).sum(2);
}

// Half sizes that exceed the least by `sizes`, or by as much of them as the cube has room for.
torch::Tensor Fitting(const torch::Tensor& sizes, const torch::Tensor& axes,
                      const torch::Tensor& lean) {
  const torch::Tensor least = torch::full_like(sizes, kLeastHalf);
  const torch::Tensor fit = (kFullest - Reach(least, axes, lean)) / Reach(sizes, axes, lean);
  return least + sizes * fit.amin(-1, true).clamp_max(1.0);
}

// A point inside each part, [N, M, 3] from its centre along the cube's axes: `share` [N, M, 3] of
// what it reaches. Within 0.7 of the half sizes along u and v it is inside a disc as well.
torch::Tensor PointInside(const torch::Tensor& share, const torch::Tensor& half,
                          const torch::Tensor& slope, const torch::Tensor& axes) {
  const torch::Tensor w = 0.9 * share.narrow(2, 2, 1) * half.narrow(2, 2, 1);
  const torch::Tensor section = half.narrow(2, 0, 2) + slope * w;
  const torch::Tensor point = torch::cat({0.7 * share.narrow(2, 0, 2) * section, w}, 2);
  return torch::matmul(axes.transpose(2, 3), point.unsqueeze(-1)).squeeze(-1);
}

// Where parts lie, [N, M, 3]: the first at its place, each of the others so that a point inside it
// meets a point inside the one before, as far as the cube has room. A chain: body, shoulder, neck
// and cap, or a graft, what it is on and another graft.
torch::Tensor Chained(const torch::Tensor& first, const torch::Tensor& joint,
                      const torch::Tensor& grip, const torch::Tensor& room) {
  std::vector<torch::Tensor> places = {first};
  for (std::int64_t k = 1; k < joint.size(1); ++k) {
    const torch::Tensor most = room.select(1, k);
    const torch::Tensor place = places.back() + joint.select(1, k - 1) - grip.select(1, k);
    places.push_back(torch::minimum(torch::maximum(place, -most), most));
  }
  return torch::stack(places, 1);
}

}  // namespace

SolidGeneratorImpl::SolidGeneratorImpl(const ModelOptions& options) : options_(options) {
  const std::int64_t units = kUnitsPerWidth * options_.width;
  const std::vector<std::int64_t> sizes = {options_.latent, units, units, units,
                                           options_.parts * kRaws};
  for (std::size_t i = 0; i + 1 < sizes.size(); ++i) {
    layers_.push_back(register_module("layer" + std::to_string(i + 1),
                                      torch::nn::Linear(sizes[i], sizes[i + 1])));
  }
  RngStream rng(0, "generator");
  Initialize(&rng);
}

void SolidGeneratorImpl::Initialize(RngStream* rng) {
  torch::NoGradGuard no_grad;
  for (torch::nn::Linear& layer : layers_) {
    const bool last = layer.get() == layers_.back().get();
    const double gain = last ? kLastGain : std::sqrt(2.0);
    const auto inputs = static_cast<double>(layer->weight.size(1));
    layer->weight.copy_(NormalTensor(layer->weight.sizes(), gain / std::sqrt(inputs), rng));
    layer->bias.copy_(NormalTensor(layer->bias.sizes(), last ? kLastBias : 0.0, rng));
    if (!last) continue;
    layer->weight.view({options_.parts, kRaws, -1})
        .narrow(1, kRound, kRaws - kRound)
        .mul_(kFormGain);
    layer->bias.view({options_.parts, kRaws}).narrow(1, kRound, kRaws - kRound).zero_();
  }
}

torch::Tensor SolidGeneratorImpl::Parts(const torch::Tensor& z) {
  torch::Tensor x = z;
  for (torch::nn::Linear& layer : layers_) {
    x = layer.get() == layers_.front().get() ? layer(x) : layer(torch::relu(x));
  }
  x = x.view({z.size(0), options_.parts, kRaws});
  const auto raw = [&](int first, int count) { return x.narrow(2, first, count); };
  const torch::Tensor axes = Axes(raw(kAxis, 3), raw(kSide, 3));
  const torch::Tensor lean = kSteepest * torch::tanh(torch::softshrink(raw(kLean, 2), kUpright));
  const torch::Tensor half = Fitting(Sizes(raw(kSize, 3)), axes, lean);
  const torch::Tensor slope = lean * (half.narrow(2, 0, 2) - kLeastHalf) / half.narrow(2, 2, 1);
  const torch::Tensor room = kRoom - Reach(half, axes, lean);
  const torch::Tensor raw_place = raw(kPlace, 3), first_room = room.select(1, 0);
  const torch::Tensor place =
      Chained(first_room * torch::tanh(kPlaceScale * raw_place.select(1, 0) / first_room),
              PointInside(torch::tanh(raw_place.roll(-1, 1)), half, slope, axes),
              PointInside(torch::tanh(raw(kGrip, 3)), half, slope, axes), room);
  return torch::cat({axes.flatten(2), torch::matmul(axes, place.unsqueeze(-1)).squeeze(-1), half,
                     Share(raw(kRound, 1) + kRoundBias), slope,
                     0.5 * half.amin(-1, true) * Share(raw(kEnds, 1) + kEndsBias),
                     torch::rsqrt(1.0 + slope.square().mean(-1, true))},
                    2);
}

torch::Tensor SolidGeneratorImpl::forward(const torch::Tensor& z) {
  const torch::Tensor values = NetworkValues(SolidField(Parts(z), options_.resolution), options_);
  return is_training() ? values : LargestPiece(values.cpu()).to(values.device());
}

torch::Tensor SolidGeneratorImpl::ForwardFolded(const torch::Tensor& z) { return Fold(forward(z)); }

}  // namespace antigrasp
