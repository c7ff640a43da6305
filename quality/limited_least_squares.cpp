#include "antigrasp/quality/limited_least_squares.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>

#include "antigrasp/core/check.h"

namespace antigrasp {
namespace {

using Eigen::Index;

// With torques in the hundreds, a regulariser of 1e-10 is below the rounding of a^T a in double:
// the minimiser among all that fit equally well would be noise. Extended precision has 11 more
// bits.
using Real = long double;
using Matrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;
using Vector = Eigen::Matrix<Real, Eigen::Dynamic, 1>;

// A multiplier smaller than this share of its terms is rounding.
constexpr Real kNoise = 100 * std::numeric_limits<Real>::epsilon();

// [a; sqrt(regularizer) I]: the regulariser as further rows, because the normal equations would
// square the condition number.
Matrix Stack(const LimitedLeastSquares& problem) {
  const Index rows = problem.a.rows(), cols = problem.a.cols();
  Matrix stacked = Matrix::Zero(rows + cols, cols);
  stacked.topRows(rows) = problem.a.cast<Real>();
  stacked.bottomRows(cols).diagonal().setConstant(
      std::sqrt(static_cast<Real>(problem.regularizer)));
  return stacked;
}

// The primal active-set method (Nocedal and Wright, Numerical Optimization, 16.5). Constraint
// i < n is x_i >= 0, constraint n + g the limit of group g. Active ones hold with equality. Those
// active at a point are always independent, since a group at its limit has a positive member.
class ActiveSet {
 public:
  explicit ActiveSet(const LimitedLeastSquares& problem)
      : a_(Stack(problem)),
        b_(Vector::Zero(a_.rows())),
        limit_(problem.limit),
        group_(problem.group.begin(), problem.group.end()),
        groups_(1 + *std::max_element(group_.begin(), group_.end())),
        x_(Vector::Zero(a_.cols())),
        active_(static_cast<std::size_t>(a_.cols() + groups_)),
        rejected_(active_.size()) {
    b_.head(problem.b.size()) = problem.b.cast<Real>();
    std::fill_n(active_.begin(), a_.cols(), true);
  }

  Eigen::VectorXd Minimise() {
    // A grasp takes about as many rounds as it has columns.
    const std::size_t most_rounds = 1000 * active_.size();
    for (std::size_t round = 0; round < most_rounds; ++round) {
      MinimiseOnActiveSet();
      if (released_ >= 0 && !(Slack(released_, target_) > 0)) {
        active_[At(released_)] = true;  // the multiplier was noise
        Reject();
        continue;
      }
      if (!StepToTarget()) {
        released_ = -1;
        continue;
      }
      if (target_value_ < best_) {
        best_ = target_value_;
        std::fill(rejected_.begin(), rejected_.end(), false);
      } else {
        Reject();
      }
      if (!ReleaseWorst()) return x_.cast<double>();
    }
    AG_CHECK(false, "the active-set method cycles");
  }

 private:
  // Not to be released again before the value falls: what ends the method under rounding.
  void Reject() {
    if (released_ >= 0) rejected_[At(released_)] = true;
    released_ = -1;
  }

  static std::size_t At(Index i) { return static_cast<std::size_t>(i); }
  Index Constraints() const { return a_.cols() + groups_; }
  bool Active(Index constraint) const { return active_[At(constraint)]; }

  // How far a point is inside a constraint.
  Real Slack(Index constraint, const Vector& x) const {
    if (constraint < a_.cols()) return x[constraint];
    Real slack = limit_;
    for (Index i = 0; i < a_.cols(); ++i) {
      if (group_[At(i)] == constraint - a_.cols()) slack -= x[i];
    }
    return slack;
  }

  // Of each group at its limit the largest free member: it is what the others leave of the limit.
  // For each x_i the pivot of its group, or -1.
  std::vector<Index> Pivots() const {
    std::vector<Index> of_group(At(groups_), -1), pivots(At(a_.cols()), -1);
    const auto limited = [&](Index i) {
      return group_[At(i)] >= 0 && Active(a_.cols() + group_[At(i)]);
    };
    for (Index i = 0; i < a_.cols(); ++i) {
      if (Active(i) || !limited(i)) continue;
      Index& pivot = of_group[At(group_[At(i)])];
      if (pivot < 0 || x_[i] > x_[pivot]) pivot = i;
    }
    for (Index i = 0; i < a_.cols(); ++i) {
      if (limited(i)) pivots[At(i)] = of_group[At(group_[At(i)])];
    }
    return pivots;
  }

  // target_, its value and the multipliers there.
  void MinimiseOnActiveSet() {
    const std::vector<Index> pivots = Pivots();
    target_ = Vector::Zero(a_.cols());
    Vector rest = b_;
    std::vector<Index> basis;
    for (Index i = 0; i < a_.cols(); ++i) {
      if (pivots[At(i)] == i) {
        target_[i] = limit_;
        rest -= limit_ * a_.col(i);
      } else if (!Active(i)) {
        basis.push_back(i);
      }
    }
    Matrix k(a_.rows(), static_cast<Index>(basis.size()));
    for (Index c = 0; c < k.cols(); ++c) {
      const Index i = basis[At(c)], pivot = pivots[At(i)];
      k.col(c) = a_.col(i);
      if (pivot >= 0) k.col(c) -= a_.col(pivot);
    }
    if (k.cols() > 0) {
      const Eigen::HouseholderQR<Matrix> qr(k);
      rest.applyOnTheLeft(qr.householderQ().adjoint());
      const auto r = qr.matrixQR().topRows(k.cols()).triangularView<Eigen::Upper>();
      const Vector y = r.solve(rest.head(k.cols()));
      rest.head(k.cols()).setZero();  // the residual by way of Q is orthogonal to k
      rest.applyOnTheLeft(qr.householderQ());
      for (Index c = 0; c < k.cols(); ++c) {
        const Index i = basis[At(c)], pivot = pivots[At(i)];
        target_[i] = y[c];
        if (pivot >= 0) target_[pivot] -= y[c];
      }
    }
    target_value_ = rest.squaredNorm();
    const Vector descent = a_.transpose() * rest;
    multipliers_ = Vector::Zero(Constraints());
    for (Index i = 0; i < a_.cols(); ++i) {
      const Real force = pivots[At(i)] >= 0 ? descent[pivots[At(i)]] : Real(0);
      if (Active(i)) multipliers_[i] = force - descent[i];
      if (pivots[At(i)] >= 0) multipliers_[a_.cols() + group_[At(i)]] = force;
    }
  }

  // Goes to target_, or as far as the first constraint in the way, which becomes active.
  bool StepToTarget() {
    Real step = 1;
    Index blocking = -1;
    for (Index c = 0; c < Constraints(); ++c) {
      if (Active(c)) continue;
      const Real ahead = Slack(c, target_);
      if (ahead >= 0) continue;
      const Real here = std::max(Slack(c, x_), Real(0));
      const Real share = here / (here - ahead);
      if (blocking < 0 || share < step) {
        step = share;
        blocking = c;
      }
    }
    if (blocking < 0) {
      x_ = target_;
      return true;
    }
    x_ = (x_ + step * (target_ - x_)).cwiseMax(Real(0));
    if (blocking < a_.cols()) x_[blocking] = 0;
    active_[At(blocking)] = true;
    return false;
  }

  // Lets go of the active constraint with the most negative multiplier relative to its column.
  bool ReleaseWorst() {
    released_ = -1;
    const Vector norms = a_.colwise().norm().transpose();
    Real worst = -kNoise * b_.norm();
    for (Index c = 0; c < Constraints(); ++c) {
      if (!Active(c) || rejected_[At(c)]) continue;
      const Real scaled = multipliers_[c] / (c < a_.cols() ? norms[c] : norms.maxCoeff());
      if (scaled < worst) {
        worst = scaled;
        released_ = c;
      }
    }
    if (released_ >= 0) active_[At(released_)] = false;
    return released_ >= 0;
  }

  const Matrix a_;
  Vector b_;
  const Real limit_;
  const std::vector<Index> group_;
  const Index groups_;
  Vector x_, target_, multipliers_;
  std::vector<bool> active_, rejected_;
  Real target_value_ = 0, best_ = std::numeric_limits<Real>::infinity();
  Index released_ = -1;  // by the last step
};

}  // namespace

Eigen::VectorXd Solve(const LimitedLeastSquares& problem) {
  AG_CHECK(problem.a.allFinite() && problem.b.allFinite(), "least squares needs finite numbers");
  AG_CHECK(problem.regularizer > 0.0 && problem.limit > 0.0, "regulariser and limit are positive");
  AG_CHECK(static_cast<Index>(problem.group.size()) == problem.a.cols() &&
               problem.a.rows() == problem.b.size(),
           "one group per column, one number per row");
  if (problem.a.cols() == 0) return {};
  return ActiveSet(problem).Minimise();
}

}  // namespace antigrasp
