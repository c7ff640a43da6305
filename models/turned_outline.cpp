#include "antigrasp/models/turned_outline.h"

#include <ATen/ATen.h>

#include "antigrasp/models/solid_terms.h"

namespace antigrasp {
namespace {

// What is said of the base and of every frustum.
enum Number { kRise, kWiden, kRound, kSkew, kNumbers };

// In units of the cube's side.
constexpr double kLeastRadius = 0.03, kLeastTop = 0.06;
constexpr double kRadius = 0.2, kRadiusSpan = 1.2;  // of the base; logarithm
constexpr double kRiseScale = 0.07, kRiseSpan = 2.0, kFlat = 0.01;
constexpr double kHollowScale = 0.03, kNoHollow = 0.009;
constexpr double kWidenGain = 0.5, kWidenSpan = 1.6;  // logarithm
constexpr double kStraight = 0.02;                    // of it: walls that lean less are upright
constexpr double kRoundBias = -0.3, kSkewSpan = 0.7, kEven = 0.2;
constexpr double kHollowFrom = 0.31;  // radius of a hollow's ceiling, of its rim's
constexpr int kSteps = 8;             // of a rounded corner

// From nothing, exactly, to `scale` e^2.
at::Tensor Height(const at::Tensor& x, double scale, double nothing) {
  return at::relu(scale * (kRiseSpan * at::tanh(x / kRiseSpan)).exp() - nothing);
}

at::Tensor Points(const at::Tensor& radius, const at::Tensor& z) {
  return at::stack({radius, z}, 2);
}

}  // namespace

at::Tensor RoundedCorners(const at::Tensor& corners, const at::Tensor& rounding,
                          const at::Tensor& skew) {
  const std::int64_t count = corners.size(1) - 2;
  const at::Tensor piece = corners.narrow(1, 1, count + 1) - corners.narrow(1, 0, count + 1);
  const at::Tensor length = piece.square().sum(2).clamp_min(1e-12).sqrt();  // [N, K - 1]
  const at::Tensor shorter =
      rounding * at::minimum(length.narrow(1, 0, count), length.narrow(1, 1, count));
  const at::Tensor none = at::zeros_like(length.narrow(1, 0, 1));
  // Of a piece, the share that the corners at its two ends take: no more than all of it.
  const at::Tensor ahead = at::cat({none, shorter * skew.exp()}, 1) / length;
  const at::Tensor back = at::cat({shorter * (-skew).exp(), none}, 1) / length;
  const at::Tensor both = (ahead + back).clamp_min(1.0);
  const at::Tensor corner = corners.narrow(1, 1, count);
  const auto along = [&](const at::Tensor& share, std::int64_t first) {
    return ((share / both).unsqueeze(2) * piece).narrow(1, first, count);
  };
  const at::Tensor from = corner - along(back, 0), to = corner + along(ahead, 1);
  const at::Tensor t = (at::arange(kSteps + 1, corners.options()) / kSteps).view({-1, 1});
  const at::Tensor curve = (1.0 - t).square() * from.unsqueeze(2) +
                           2.0 * t * (1.0 - t) * corner.unsqueeze(2) + t.square() * to.unsqueeze(2);
  return at::cat({corners.narrow(1, 0, 1), curve.flatten(1, 2), corners.narrow(1, count + 1, 1)},
                 1);
}

at::Tensor Outlines(const at::Tensor& numbers, std::int64_t frusta, double room) {
  const at::Tensor x =
      numbers.narrow(1, 0, kNumbers * (frusta + 1)).view({-1, frusta + 1, kNumbers});
  const at::Tensor base = x.select(1, 0), walls = x.narrow(1, 1, frusta);
  // Radii, one the other's multiple: what is above keeps its form where what is below grows.
  const at::Tensor widen = at::softshrink(
      kWidenSpan * at::tanh(walls.select(2, kWiden) * (kWidenGain / kWidenSpan)), kStraight);
  const at::Tensor first = kRadiusSpan * at::tanh(base.narrow(1, kWiden, 1) / kRadiusSpan);
  const at::Tensor radius = kRadius * at::cat({first, first + widen.cumsum(1)}, 1).exp();
  const at::Tensor rise = Height(walls.select(2, kRise), kRiseScale, kFlat);
  const at::Tensor top = at::constant_pad_nd(rise.new_full({1, 1}, kLeastTop), {frusta - 1, 0});
  const at::Tensor z = at::constant_pad_nd((rise + top).cumsum(1), {1, 0});  // [N, frusta + 1]
  const at::Tensor height = z.narrow(1, frusta, 1);
  const at::Tensor scale = (2.0 * room / height).clamp_max(1.0);
  const at::Tensor walls_radius = (scale * radius).clamp(kLeastRadius, room);
  const at::Tensor walls_z = scale * (z - 0.5 * height);
  const at::Tensor bottom = walls_z.narrow(1, 0, 1), none = at::zeros_like(bottom);
  const at::Tensor hollow = at::minimum(
      scale * Height(base.narrow(1, kRise, 1), kHollowScale, kNoHollow), 0.5 * scale * height);
  const at::Tensor rim = walls_radius.narrow(1, 0, 1) *
                         (0.55 + 0.35 * at::tanh(numbers.narrow(1, kNumbers * (frusta + 1), 1)));
  const at::Tensor corners =
      at::cat({Points(none, bottom + hollow), Points(kHollowFrom * rim, bottom + hollow),
               Points(rim, bottom), Points(walls_radius, walls_z),
               Points(none, walls_z.narrow(1, frusta, 1))},
              1);
  const at::Tensor all = at::ones_like(none);
  const at::Tensor rounding = at::cat({all, 0.5 * all, Share(x.select(2, kRound) + kRoundBias)}, 1);
  const at::Tensor skew =
      kSkewSpan * at::tanh(at::softshrink(x.select(2, kSkew), kEven) / kSkewSpan);
  return RoundedCorners(corners, rounding, at::cat({none, none, skew}, 1));
}

}  // namespace antigrasp
