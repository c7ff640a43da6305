#include "antigrasp/models/few_bends.h"

#include <ATen/ATen.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "antigrasp/core/pieces.h"

namespace antigrasp {
namespace {

constexpr double kBand = 2.0;  // cells from the surface
constexpr double kNear = 1.5, kFarWeight = 0.02;
constexpr double kFirstEpsilon = 0.1, kLastEpsilon = 0.005;

using Numbers = std::vector<double>;

// x[before] - 2 x[middle] + x[after].
struct Central {
  std::int32_t before, middle, after;
};

// x[a] - x[b] - x[c] + x[d] over a square of the grid.
struct Mixed {
  std::int32_t a, b, c, d;
};

// The nodes near the surface of one shape, numbered, and the second differences among them.
class Band {
 public:
  Band(const float* value, std::int64_t r) {
    const std::array<std::int64_t, 3> stride = {1, r, r * r};
    std::vector<std::int32_t> number(static_cast<std::size_t>(r * r * r), -1);
    for (std::int64_t node = 0; node < r * r * r; ++node) {
      if (!(std::abs(value[node]) < kBand)) continue;
      number[static_cast<std::size_t>(node)] = static_cast<std::int32_t>(nodes.size());
      nodes.push_back(node);
    }
    const auto at = [&](std::int64_t node) { return number[static_cast<std::size_t>(node)]; };
    for (const std::int64_t node : nodes) {
      const std::int32_t here = at(node);
      for (std::size_t i = 0; i < 3; ++i) {
        const std::int64_t place = node / stride[i] % r;
        if (place + 1 == r) continue;
        const std::int32_t next = at(node + stride[i]);
        if (place > 0 && at(node - stride[i]) >= 0 && next >= 0) {
          central.push_back({at(node - stride[i]), here, next});
        }
        for (std::size_t j = i + 1; j < 3; ++j) {
          if (node / stride[j] % r + 1 == r) continue;
          const std::int32_t beside = at(node + stride[j]),
                             across = at(node + stride[i] + stride[j]);
          if (next >= 0 && beside >= 0 && across >= 0)
            mixed.push_back({here, next, beside, across});
        }
      }
    }
  }

  std::vector<std::int64_t> nodes;
  std::vector<Central> central;
  std::vector<Mixed> mixed;
};

// The quadratic problem of a round: stay x^T S x plus weighted squares of the differences.
class Round {
 public:
  Round(const Band& band, const Numbers& stay) : band_(band), stay_(stay) {}

  // Weights of the differences where the shape is now. |H|^2 counts a mixed difference twice, and
  // the node has a quarter of each of the four around it.
  void Reweight(const Numbers& x, const FewBends& options, double epsilon) {
    Numbers weight(x.size(), epsilon * epsilon);
    for (const Central& t : band_.central) {
      const double bend = x[t.before] - 2.0 * x[t.middle] + x[t.after];
      weight[t.middle] += bend * bend;
    }
    for (const Mixed& t : band_.mixed) {
      const double bend = x[t.a] - x[t.b] - x[t.c] + x[t.d], half = 0.5 * bend * bend;
      for (const std::int32_t corner : {t.a, t.b, t.c, t.d}) weight[corner] += half;
    }
    for (double& w : weight) {
      w = 0.5 * options.weight * options.power * std::pow(w, 0.5 * options.power - 1.0);
    }
    central_.clear();
    for (const Central& t : band_.central) central_.push_back(weight[t.middle]);
    mixed_.clear();
    for (const Mixed& t : band_.mixed) {
      mixed_.push_back(0.5 * (weight[t.a] + weight[t.b] + weight[t.c] + weight[t.d]));
    }
    diagonal_ = stay_;
    for (std::size_t i = 0; i < central_.size(); ++i) {
      const Central& t = band_.central[i];
      diagonal_[t.before] += central_[i];
      diagonal_[t.middle] += 4.0 * central_[i];
      diagonal_[t.after] += central_[i];
    }
    for (std::size_t i = 0; i < mixed_.size(); ++i) {
      const Mixed& t = band_.mixed[i];
      for (const std::int32_t corner : {t.a, t.b, t.c, t.d}) diagonal_[corner] += mixed_[i];
    }
  }

  // Conjugate gradients from x, preconditioned by the diagonal.
  void Improve(const Numbers& x0, int iterations, Numbers* x) const {
    const std::size_t n = x0.size();
    Numbers residual(n), way(n), applied(n);
    Apply(*x, &applied);
    double along = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      residual[i] = stay_[i] * x0[i] - applied[i];
      way[i] = residual[i] / diagonal_[i];
      along += residual[i] * way[i];
    }
    for (int k = 0; k < iterations && along > 0.0; ++k) {
      Apply(way, &applied);
      double curvature = 0.0;
      for (std::size_t i = 0; i < n; ++i) curvature += way[i] * applied[i];
      if (!(curvature > 0.0)) return;
      const double step = along / curvature;
      double next = 0.0;
      for (std::size_t i = 0; i < n; ++i) {
        (*x)[i] += step * way[i];
        residual[i] -= step * applied[i];
        next += residual[i] * residual[i] / diagonal_[i];
      }
      const double keep = next / std::exchange(along, next);
      for (std::size_t i = 0; i < n; ++i) way[i] = residual[i] / diagonal_[i] + keep * way[i];
    }
  }

 private:
  void Apply(const Numbers& x, Numbers* out) const {
    for (std::size_t i = 0; i < x.size(); ++i) (*out)[i] = stay_[i] * x[i];
    for (std::size_t i = 0; i < central_.size(); ++i) {
      const Central& t = band_.central[i];
      const double bend = central_[i] * (x[t.before] - 2.0 * x[t.middle] + x[t.after]);
      (*out)[t.before] += bend;
      (*out)[t.middle] -= 2.0 * bend;
      (*out)[t.after] += bend;
    }
    for (std::size_t i = 0; i < mixed_.size(); ++i) {
      const Mixed& t = band_.mixed[i];
      const double bend = mixed_[i] * (x[t.a] - x[t.b] - x[t.c] + x[t.d]);
      (*out)[t.a] += bend;
      (*out)[t.b] -= bend;
      (*out)[t.c] -= bend;
      (*out)[t.d] += bend;
    }
  }

  const Band& band_;
  const Numbers& stay_;
  Numbers central_, mixed_, diagonal_;
};

void Fair(const FewBends& options, std::int64_t r, float* value) {
  const Band band(value, r);
  Numbers x0, stay;
  for (const std::int64_t node : band.nodes) {
    const double x = value[node];
    x0.push_back(x);
    stay.push_back(std::exp(-(x / kNear) * (x / kNear)) + kFarWeight);
  }
  Numbers x = x0;
  Round round(band, stay);
  for (int k = 0; k < options.rounds; ++k) {
    const double share = options.rounds > 1 ? double(k) / (options.rounds - 1) : 1.0;
    round.Reweight(x, options, kFirstEpsilon * std::pow(kLastEpsilon / kFirstEpsilon, share));
    round.Improve(x0, options.iterations, &x);
  }
  for (std::size_t i = 0; i < x.size(); ++i) value[band.nodes[i]] = static_cast<float>(x[i]);
}

}  // namespace

at::Tensor WithFewBends(const at::Tensor& distances, const FewBends& options) {
  at::Tensor faired = distances.detach().clone(at::MemoryFormat::Contiguous);
  const std::int64_t r = faired.size(4);
  auto* data = faired.data_ptr<float>();
  ForPieces(faired.size(0), [&](std::int64_t i) { Fair(options, r, data + i * r * r * r); });
  return faired;
}

}  // namespace antigrasp
