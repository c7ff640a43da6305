#include "antigrasp/datasets/set_comparison.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

#include "antigrasp/core/check.h"
#include "antigrasp/core/statistics.h"

namespace antigrasp {
namespace {

using Distances = Eigen::Ref<const DistanceMatrix>;

// Of every shape to the nearest other one of its set.
std::vector<double> NearestOthers(const Distances& distances) {
  std::vector<double> nearest;
  for (Eigen::Index i = 0; i < distances.rows(); ++i) {
    float least = std::numeric_limits<float>::infinity();
    for (Eigen::Index j = 0; j < distances.cols(); ++j) {
      if (j != i) least = std::min(least, distances(i, j));
    }
    nearest.push_back(least);
  }
  return nearest;
}

double Mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

// Of all pairs of shapes.
std::vector<double> Pairs(const Distances& distances) {
  std::vector<double> pairs;
  for (Eigen::Index i = 0; i < distances.rows(); ++i) {
    for (Eigen::Index j = i + 1; j < distances.cols(); ++j) pairs.push_back(distances(i, j));
  }
  return pairs;
}

SetSpread Spread(const std::vector<double>& nearest, const std::vector<double>& pairs,
                 double near) {
  const auto duplicates = std::count_if(nearest.begin(), nearest.end(),
                                        [near](double distance) { return distance < near; });
  return {static_cast<double>(duplicates) / static_cast<double>(nearest.size()), Mean(pairs)};
}

bool AmongThemselves(const Distances& distances) {
  return distances.rows() >= 2 && distances.cols() == distances.rows();
}

}  // namespace

SetComparison CompareSets(const Distances& samples, const Distances& between,
                          const Distances& reference) {
  AG_CHECK(AmongThemselves(samples) && AmongThemselves(reference), "sets of at least two shapes");
  const Eigen::Index n = between.rows();
  AG_CHECK(samples.rows() == n && reference.rows() == n && between.cols() == n,
           "sets of the same size");
  const std::vector<double> among_samples = NearestOthers(samples);
  const std::vector<double> among_reference = NearestOthers(reference);
  std::vector<double> to_reference, to_samples;
  std::vector<bool> covered(static_cast<std::size_t>(n), false);
  int own = 0;
  for (Eigen::Index i = 0; i < n; ++i) {
    Eigen::Index nearest = 0;
    to_reference.push_back(between.row(i).minCoeff(&nearest));
    covered[static_cast<std::size_t>(nearest)] = true;
    to_samples.push_back(between.col(i).minCoeff());
    own += among_samples[static_cast<std::size_t>(i)] < to_reference.back();
    own += among_reference[static_cast<std::size_t>(i)] < to_samples.back();
  }
  SetComparison result;
  result.coverage = static_cast<double>(std::count(covered.begin(), covered.end(), true)) /
                    static_cast<double>(n);
  result.matching = Mean(to_samples);
  result.nna = own / static_cast<double>(2 * n);
  result.to_reference = Mean(to_reference);
  result.within_reference = Mean(among_reference);
  return result;
}

SpreadComparison CompareSpreads(const Distances& samples, const Distances& reference) {
  AG_CHECK(AmongThemselves(samples) && AmongThemselves(reference), "sets of at least two shapes");
  const std::vector<double> nearest = NearestOthers(reference), pairs = Pairs(reference);
  const double near = 0.5 * DiscretePercentile(nearest, 50.0);
  SpreadComparison result;
  result.samples = Spread(NearestOthers(samples), Pairs(samples), near);
  result.reference = Spread(nearest, pairs, near);
  result.median_distance = DiscretePercentile(pairs, 50.0);
  const double spread = result.reference.mean_distance;
  result.diversity = spread > 0.0 ? result.samples.mean_distance / spread : 0.0;
  return result;
}

DistanceMatrix WithoutFloors(const Distances& distances, const std::vector<double>& floors) {
  AG_CHECK(distances.rows() == distances.cols() &&
               distances.rows() == static_cast<Eigen::Index>(floors.size()),
           "a floor for every shape");
  DistanceMatrix clean = DistanceMatrix::Zero(distances.rows(), distances.cols());
  for (Eigen::Index i = 0; i < distances.rows(); ++i) {
    for (Eigen::Index j = 0; j < distances.cols(); ++j) {
      const double d = distances(i, j);
      const double f =
          0.5 * (floors[static_cast<std::size_t>(i)] + floors[static_cast<std::size_t>(j)]);
      clean(i, j) = static_cast<float>(std::sqrt(std::max(0.0, d * d - f * f)));
    }
  }
  return clean;
}

double VendiScore(const Distances& distances, double scale) {
  const Eigen::Index n = distances.rows();
  AG_CHECK(n >= 1 && distances.cols() == n, "the distances of one set");
  Eigen::MatrixXd kernel(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) {
      const double d = distances(i, j);
      // Equal shapes at any scale, 0 included.
      kernel(i, j) = d == 0.0 ? 1.0 : std::exp(-0.5 * (d / scale) * (d / scale));
    }
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(kernel, Eigen::EigenvaluesOnly);
  AG_CHECK(solver.info() == Eigen::Success, "finite distances");
  const Eigen::ArrayXd values = solver.eigenvalues().array().max(0.0);
  const double sum = values.sum();
  double entropy = 0.0;
  for (const double value : values) {
    if (value > 0.0) entropy -= value / sum * std::log(value / sum);
  }
  return std::exp(entropy);
}

}  // namespace antigrasp
