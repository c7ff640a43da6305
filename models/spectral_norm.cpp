#include "antigrasp/models/spectral_norm.h"

#include <torch/utils.h>

#include "antigrasp/models/elementwise.h"
#include "antigrasp/models/random_tensor.h"

namespace antigrasp {
namespace {

constexpr double kEpsilon = 1e-12;
constexpr int kWarmUpIterations = 15;

torch::Tensor Normalised(const torch::Tensor& vector) {
  return vector / vector.norm().clamp_min(kEpsilon);
}

}  // namespace

SpectralWeightImpl::SpectralWeightImpl(at::IntArrayRef shape, bool normalise)
    : normalise_(normalise), weight_(register_parameter("weight", torch::zeros(shape))) {
  if (normalise_) {
    u_ = register_buffer("u", torch::zeros({shape[0]}));
  }
}

void SpectralWeightImpl::Initialize(double sd, RngStream* rng) {
  torch::NoGradGuard no_grad;
  weight_.copy_(NormalTensor(weight_.sizes(), sd, rng));
  if (normalise_) {
    u_.copy_(Normalised(NormalTensor(u_.sizes(), 1.0, rng)));
    for (int i = 0; i < kWarmUpIterations; ++i) {
      Iterate();
    }
  }
}

torch::Tensor SpectralWeightImpl::Matrix() const { return weight_.flatten(1); }

void SpectralWeightImpl::Iterate() {
  if (!normalise_) return;
  torch::NoGradGuard no_grad;
  const torch::Tensor matrix = Matrix();
  u_.copy_(Normalised(matrix.mv(Normalised(matrix.t().mv(u_)))));
}

torch::Tensor SpectralWeightImpl::Sigma() {
  const torch::Tensor matrix = Matrix();
  // A copy: the next forward moves u before this one's backward may have run.
  const torch::Tensor u = u_.clone();
  const torch::Tensor v = Normalised(matrix.detach().t().mv(u));
  return u.dot(matrix.mv(v)).clamp_min(kEpsilon);
}

torch::Tensor SpectralWeightImpl::forward() {
  if (!normalise_) {
    return weight_;
  }
  if (is_training()) Iterate();
  // In evaluation a loss may hold two quotients of one W (gan.gradient_penalty), whose gradients
  // are summed in LibTorch's order.
  if (!is_training() || !weight_.is_cpu()) return weight_ / Sigma();
  const torch::Tensor u = u_.clone();  // as in Sigma
  return DivideBySigma(weight_, u, Normalised(Matrix().detach().t().mv(u)), kEpsilon);
}

}  // namespace antigrasp
