#include "antigrasp/perturb/evolution.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "antigrasp/core/check.h"

namespace antigrasp {

using Eigen::MatrixXd;
using Eigen::VectorXd;

CmaEs::CmaEs(const VectorXd& start, double step, int population) : mean_(start), step_(step) {
  const auto n = static_cast<double>(start.size());
  population_ = population > 0 ? population : 4 + static_cast<int>(3.0 * std::log(n));
  AG_CHECK(start.size() > 0 && step > 0.0 && population_ > 1, "something to search");
  parents_ = population_ / 2;
  weights_.resize(parents_);
  for (int i = 0; i < parents_; ++i) {
    weights_[i] = std::log(0.5 * (population_ + 1.0)) - std::log(i + 1.0);
  }
  weights_ /= weights_.sum();
  mass_ = 1.0 / weights_.squaredNorm();
  by_step_ = (mass_ + 2.0) / (n + mass_ + 5.0);
  damping_ = 1.0 + by_step_ + 2.0 * std::max(0.0, std::sqrt((mass_ - 1.0) / (n + 1.0)) - 1.0);
  by_path_ = (4.0 + mass_ / n) / (n + 4.0 + 2.0 * mass_ / n);
  by_one_ = 2.0 / ((n + 1.3) * (n + 1.3) + mass_);
  by_parents_ =
      std::min(1.0 - by_one_, 2.0 * (mass_ - 2.0 + 1.0 / mass_) / ((n + 2.0) * (n + 2.0) + mass_));
  usual_length_ = std::sqrt(n) * (1.0 - 1.0 / (4.0 * n) + 1.0 / (21.0 * n * n));
  path_step_ = path_shape_ = VectorXd::Zero(start.size());
  covariance_ = axes_ = MatrixXd::Identity(start.size(), start.size());
  deviations_ = VectorXd::Ones(start.size());
}

const MatrixXd& CmaEs::Ask(RngStream* rng) {
  samples_.resize(mean_.size(), population_);
  for (Eigen::Index k = 0; k < samples_.cols(); ++k) {
    VectorXd draw(mean_.size());
    for (double& x : draw) x = rng->Normal();
    samples_.col(k) = mean_ + step_ * (axes_ * deviations_.cwiseProduct(draw));
  }
  return samples_;
}

void CmaEs::Tell(const std::vector<double>& values) {
  AG_CHECK(std::ssize(values) == population_ && samples_.cols() == population_, "a value a sample");
  std::vector<Eigen::Index> order(values.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](Eigen::Index a, Eigen::Index b) {
    return values[static_cast<std::size_t>(a)] < values[static_cast<std::size_t>(b)];
  });
  ++generation_;
  MatrixXd steps(mean_.size(), parents_);
  for (int i = 0; i < parents_; ++i) {
    steps.col(i) = (samples_.col(order[static_cast<std::size_t>(i)]) - mean_) / step_;
  }
  const VectorXd mean_move = steps * weights_;
  mean_ += step_ * mean_move;
  const VectorXd white = axes_ * (axes_.transpose() * mean_move).cwiseQuotient(deviations_);
  path_step_ =
      (1.0 - by_step_) * path_step_ + std::sqrt(by_step_ * (2.0 - by_step_) * mass_) * white;
  const double length =
      path_step_.norm() / std::sqrt(1.0 - std::pow(1.0 - by_step_, 2 * generation_));
  const bool steady =
      length < (1.4 + 2.0 / (static_cast<double>(mean_.size()) + 1.0)) * usual_length_;
  path_shape_ = (1.0 - by_path_) * path_shape_;
  if (steady) path_shape_ += std::sqrt(by_path_ * (2.0 - by_path_) * mass_) * mean_move;
  const double lost = steady ? 0.0 : by_one_ * by_path_ * (2.0 - by_path_);
  covariance_ = (1.0 - by_one_ - by_parents_ + lost) * covariance_ +
                by_one_ * path_shape_ * path_shape_.transpose() +
                by_parents_ * steps * weights_.asDiagonal() * steps.transpose();
  step_ *= std::exp(by_step_ / damping_ * (path_step_.norm() / usual_length_ - 1.0));
  Decompose();
}

void CmaEs::Decompose() {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(covariance_);
  axes_ = solver.eigenvectors();
  deviations_ = solver.eigenvalues().cwiseMax(1e-20).cwiseSqrt();
}

}  // namespace antigrasp
