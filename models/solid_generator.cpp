#include "antigrasp/models/solid_generator.h"

#include <torch/nn/functional/normalization.h>

#include <cmath>
#include <string>

#include "antigrasp/core/check.h"
#include "antigrasp/models/folding.h"
#include "antigrasp/models/largest_piece.h"
#include "antigrasp/models/random_tensor.h"
#include "antigrasp/models/sdf_values.h"
#include "antigrasp/models/solid_field.h"
#include "antigrasp/models/solid_reach.h"
#include "antigrasp/models/solid_terms.h"
#include "antigrasp/models/turned_field.h"
#include "antigrasp/models/turned_outline.h"

namespace antigrasp {
namespace {

// What the last layer says of a part; numbers of about 1, any are allowed.
enum Raw { kJoint = 0, kSize = 3, kAxis = 6, kGrip = 12, kRound = 15, kLean = 16, kEnds = 18 };
constexpr std::int64_t kRaws = 19;

constexpr int kUnitsPerWidth = 32;
constexpr double kLastGain = 0.7, kLastBias = 0.5;  // deviations of what the last layer begins with
// Of turned solids: each z another one, about the mean of the set. Kinds of bottles that no first
// is near are learnt late or never.
constexpr double kTurnedGain = 1.2, kTurnedBias = 0.2;

// In units of the cube's side. A part is never thinner than two cells of 32^3: one that is comes
// and goes with where the nodes lie, and its rim is saw teeth.
constexpr double kSizeScale = 0.12, kLeastHalf = 0.03;
constexpr double kLargestSize = 1.3;  // logarithm
constexpr double kFreeCells = 2.0;    // on each side of every set's largest shapes
constexpr double kSteepest = 0.9;     // of the lean that thins an end down to that
// Parts begin as boxes, nearly: a form that were drawn at random would be learnt last, and grafts
// of prisms would stay cones. Leans and the two sides of a section that are nearly nothing and
// nearly equal are so exactly.
constexpr double kFormGain = 0.25;  // of what the last layer begins with
constexpr double kRoundBias = -1.2, kEndsBias = -1.4;
constexpr double kCylinderBias = 2.2;  // where Share is 1
constexpr double kDiscGain = 0.1;      // of the second side of a section that begins as a disc
constexpr double kStraight = 1.0, kUpright = 0.25, kEqualSides = 0.1;

torch::Tensor Unit(const torch::Tensor& x) {
  return torch::nn::functional::normalize(x, torch::nn::functional::NormalizeFuncOptions().dim(-1));
}

// Two of the frame's axes by Gram and Schmidt, near those of the cube: [N, M, 3, 3], rows. Slight
// turns are none: a network that trains, and still more the average of its weights, would tilt
// every part that should be upright a little.
torch::Tensor Axes(const torch::Tensor& turn) {
  const torch::Tensor size = turn.norm(2, -1, true);
  const torch::Tensor rest = turn * (1.0 - kStraight / size.clamp_min(kStraight));
  const torch::Tensor cube = torch::eye(3, turn.options());
  const torch::Tensor u = Unit(rest.narrow(2, 0, 3) + cube[0]);
  const torch::Tensor side = rest.narrow(2, 3, 3) + cube[1];
  const torch::Tensor v = Unit(side - (u * side).sum(-1, true) * u);
  return torch::stack({u, v, torch::cross(u, v, -1)}, 2);
}

// By how much half sizes along u, v and w exceed the least; about equal sides are equal.
torch::Tensor Sizes(const torch::Tensor& raw) {
  const torch::Tensor size = kLargestSize * torch::tanh(raw * (0.5 / kLargestSize));  // logarithms
  const torch::Tensor u = size.narrow(2, 0, 1);
  const torch::Tensor v = u + torch::softshrink(size.narrow(2, 1, 1), kEqualSides);
  return kSizeScale * torch::cat({u, v, size.narrow(2, 2, 1)}, 2).exp();
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

// Where parts lie, [N, M, 3]: the first anywhere, each of the others so that a point inside it
// meets a point inside the one before. A chain: body, shoulder, neck and cap, or a graft, what it
// is on and another graft.
torch::Tensor Chained(const torch::Tensor& joint, const torch::Tensor& grip) {
  std::vector<torch::Tensor> places = {torch::zeros_like(joint.select(1, 0))};
  for (std::int64_t k = 1; k < joint.size(1); ++k) {
    places.push_back(places.back() + joint.select(1, k - 1) - grip.select(1, k));
  }
  return torch::stack(places, 1);
}

// A union as it is drawn: columns of solid_field.h, `lean` and `ends` as shares of the most.
struct Draft {
  torch::Tensor axes, half, round, lean, ends, place;

  torch::Tensor Slope() const {
    return lean * (half.narrow(2, 0, 2) - kLeastHalf) / half.narrow(2, 2, 1);
  }
  torch::Tensor Fillet() const { return 0.5 * half.amin(-1, true) * ends; }
  SolidReach Reach() const { return ReachOf({axes, half, round, Slope(), Fillet()}); }
};

Draft Drawn(const torch::Tensor& x, PartForm form) {  // [N, M, kRaws]
  const auto raw = [&](int first, int count) { return x.narrow(2, first, count); };
  Draft draft;
  draft.axes = Axes(raw(kAxis, 6));
  draft.half = kLeastHalf + Sizes(raw(kSize, 3));
  draft.round = Share(raw(kRound, 1) + (form == PartForm::kCylinders ? kCylinderBias : kRoundBias));
  draft.lean = kSteepest * torch::tanh(torch::softshrink(raw(kLean, 2), kUpright));
  draft.ends = Share(raw(kEnds, 1) + kEndsBias);
  const auto inside = [&](const torch::Tensor& share) {
    return PointInside(torch::tanh(share), draft.half, draft.Slope(), draft.axes);
  };
  draft.place = Chained(inside(raw(kJoint, 3).roll(-1, 1)), inside(raw(kGrip, 3)));
  return draft;
}

// How many numbers the last layer draws.
std::int64_t NumbersOf(const ModelOptions& options) {
  return options.form == PartForm::kTurned ? OutlineNumbers(options.parts) : options.parts * kRaws;
}

double Room(const ModelOptions& options) { return 0.5 - kFreeCells / options.resolution; }

// Moves the middle of the bounding box to that of the cube, where it is in every set, and scales
// what would reach farther than `room` as a whole. A network would learn neither exactly, and sets
// of shapes that lie a cell off are told from theirs at a glance.
void PutIntoTheMiddle(double room, Draft* draft) {
  SolidReach reach = draft->Reach();
  const torch::Tensor top = (draft->place + reach.up).amax(1, true);
  const torch::Tensor bottom = (draft->place - reach.down).amin(1, true);
  const torch::Tensor scale = (2.0 * room / (top - bottom).amax(2, true)).clamp_max(1.0);
  draft->place = scale * (draft->place - 0.5 * (top + bottom));
  draft->half = (scale * draft->half).clamp_min(kLeastHalf);
  reach = draft->Reach();  // what must not get thinner may still reach too far
  draft->place = torch::minimum(torch::maximum(draft->place, reach.down - room), room - reach.up);
}

}  // namespace

SolidGeneratorImpl::SolidGeneratorImpl(const ModelOptions& options) : options_(options) {
  const std::int64_t units = kUnitsPerWidth * options_.width;
  const std::vector<std::int64_t> sizes = {options_.latent, units, units, units,
                                           NumbersOf(options_)};
  for (std::size_t i = 0; i + 1 < sizes.size(); ++i) {
    layers_.push_back(register_module("layer" + std::to_string(i + 1),
                                      torch::nn::Linear(sizes[i], sizes[i + 1])));
  }
  if (IsTurned()) {
    mean_ = register_buffer("mean", torch::zeros({PartNumbers()}));
    deviation_ = register_buffer("deviation", torch::ones({PartNumbers()}));
  }
  RngStream rng(0, "generator");
  Initialize(&rng);
}

void SolidGeneratorImpl::Initialize(RngStream* rng) {
  torch::NoGradGuard no_grad;
  const bool turned = IsTurned();
  if (turned) Standardise(torch::zeros_like(mean_), torch::ones_like(deviation_));
  const double last_gain = turned ? kTurnedGain : kLastGain;
  const double last_bias = turned ? kTurnedBias : kLastBias;
  for (torch::nn::Linear& layer : layers_) {
    const bool last = layer.get() == layers_.back().get();
    const double gain = last ? last_gain : std::sqrt(2.0);
    const auto inputs = static_cast<double>(layer->weight.size(1));
    layer->weight.copy_(NormalTensor(layer->weight.sizes(), gain / std::sqrt(inputs), rng));
    layer->bias.copy_(NormalTensor(layer->bias.sizes(), last ? last_bias : 0.0, rng));
    if (!last || turned) continue;
    layer->weight.view({options_.parts, kRaws, -1})
        .narrow(1, kRound, kRaws - kRound)
        .mul_(kFormGain);
    layer->bias.view({options_.parts, kRaws}).narrow(1, kRound, kRaws - kRound).zero_();
    if (options_.form != PartForm::kCylinders) continue;
    layer->weight.view({options_.parts, kRaws, -1}).narrow(1, kSize + 1, 1).mul_(kDiscGain);
    layer->bias.view({options_.parts, kRaws}).narrow(1, kSize + 1, 1).zero_();
  }
}

std::int64_t SolidGeneratorImpl::PartNumbers() const { return NumbersOf(options_); }

void SolidGeneratorImpl::Standardise(const torch::Tensor& mean, const torch::Tensor& deviation) {
  AG_CHECK(IsTurned(), "a solid of parts draws its numbers as they are");
  torch::NoGradGuard no_grad;
  mean_.copy_(mean);
  deviation_.copy_(deviation);
}

torch::Tensor SolidGeneratorImpl::Layers(const torch::Tensor& z) {
  torch::Tensor x = z.narrow(1, 0, options_.latent);
  for (torch::nn::Linear& layer : layers_) {
    x = layer.get() == layers_.front().get() ? layer(x) : layer(torch::relu(x));
  }
  return x;
}

torch::Tensor SolidGeneratorImpl::Numbers(const torch::Tensor& z) {
  torch::Tensor x = Layers(z);
  if (IsTurned()) x = mean_ + deviation_ * x;
  return z.size(1) > options_.latent ? x + z.narrow(1, options_.latent, PartNumbers()) : x;
}

torch::Tensor SolidGeneratorImpl::Outlines(const torch::Tensor& z) {
  AG_CHECK(IsTurned(), "a solid of parts has no outline");
  return antigrasp::Outlines(Numbers(z), options_.parts, Room(options_));
}

torch::Tensor SolidGeneratorImpl::Parts(const torch::Tensor& z) {
  AG_CHECK(!IsTurned(), "a turned solid has an outline");
  Draft draft = Drawn(Numbers(z).view({z.size(0), options_.parts, kRaws}), options_.form);
  PutIntoTheMiddle(Room(options_), &draft);
  const torch::Tensor slope = draft.Slope();
  return torch::cat(
      {draft.axes.flatten(2), torch::matmul(draft.axes, draft.place.unsqueeze(-1)).squeeze(-1),
       draft.half, draft.round, slope, draft.Fillet(),
       torch::rsqrt(1.0 + slope.square().mean(-1, true))},
      2);
}

torch::Tensor SolidGeneratorImpl::OfNumbers(const torch::Tensor& numbers) {
  AG_CHECK(IsTurned(), "numbers of an outline");
  const torch::Tensor outlines = antigrasp::Outlines(numbers, options_.parts, Room(options_));
  return NetworkValues(TurnedField(outlines, options_.resolution), options_);
}

torch::Tensor SolidGeneratorImpl::forward(const torch::Tensor& z) {
  const torch::Tensor values =
      IsTurned() ? OfNumbers(Numbers(z))
                 : NetworkValues(SolidField(Parts(z), options_.resolution), options_);
  return is_training() ? values : LargestPiece(values.cpu()).to(values.device());
}

torch::Tensor SolidGeneratorImpl::ForwardJudged(const torch::Tensor& z) {
  return IsTurned() ? Layers(z) : Fold(forward(z));
}

}  // namespace antigrasp
