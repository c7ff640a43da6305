#pragma once

#include <Eigen/Core>
#include <vector>

#include "antigrasp/core/rng.h"

namespace antigrasp {

// Covariance matrix adaptation (CMA-ES): minimises a noisy function of some dozen numbers without a
// derivative. The (mu / mu_w, lambda) strategy with rank-one and rank-mu update and the constants
// of N. Hansen, "The CMA Evolution Strategy: A Tutorial" (arXiv:1604.00772, 2016), all weights
// positive. Only the order of the values counts.
//
//   CmaEs search(start, 0.1);
//   while (...) { x = search.Ask(&rng); ... search.Tell(values of x's columns); }
class CmaEs {
 public:
  // `step`: standard deviation of the first samples, of each number. `population` 0: 4 + 3 ln n.
  CmaEs(const Eigen::VectorXd& start, double step, int population = 0);

  int population() const { return population_; }
  const Eigen::VectorXd& mean() const { return mean_; }
  double step() const { return step_; }

  const Eigen::MatrixXd& Ask(RngStream* rng);    // a column each
  void Tell(const std::vector<double>& values);  // of the last Ask's columns; smaller is better

 private:
  void Decompose();

  int population_, parents_, generation_ = 0;
  Eigen::VectorXd weights_, mean_, path_step_, path_shape_, deviations_;
  double step_, mass_, by_step_, damping_, by_path_, by_one_, by_parents_, usual_length_;
  Eigen::MatrixXd covariance_, axes_, samples_;  // covariance = axes deviations^2 axes^T
};

}  // namespace antigrasp
