#include "antigrasp/train/elites.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>

#include "antigrasp/core/check.h"

namespace antigrasp {
namespace {

// Of the objects that have one; ties by index.
std::vector<std::int64_t> LeastGraspableFirst(const std::vector<double>& graspability) {
  std::vector<std::int64_t> indices;
  for (std::size_t i = 0; i < graspability.size(); ++i) {
    if (!std::isnan(graspability[i])) indices.push_back(static_cast<std::int64_t>(i));
  }
  std::stable_sort(indices.begin(), indices.end(), [&](std::int64_t a, std::int64_t b) {
    return graspability[static_cast<std::size_t>(a)] < graspability[static_cast<std::size_t>(b)];
  });
  return indices;
}

}  // namespace

std::vector<std::int64_t> LeastGraspable(const std::vector<double>& graspability,
                                         std::int64_t keep) {
  std::vector<std::int64_t> indices = LeastGraspableFirst(graspability);
  indices.resize(std::min(indices.size(), static_cast<std::size_t>(keep)));
  std::sort(indices.begin(), indices.end());
  return indices;
}

std::vector<double> RandomOrder(const std::vector<double>& graspability, RngStream* rng) {
  std::vector<double> order;
  for (const double value : graspability) {
    const double key = rng->Uniform();
    order.push_back(std::isnan(value) ? value : key);
  }
  return order;
}

std::vector<std::int64_t> SharesOf(const std::vector<double>& weight, std::int64_t total) {
  const double sum = std::accumulate(weight.begin(), weight.end(), 0.0);
  AG_CHECK(sum > 0.0, "at least one cell has a weight");
  std::vector<std::int64_t> shares;
  std::vector<double> remainders;
  std::int64_t given = 0;
  for (const double w : weight) {
    const double exact = static_cast<double>(total) * w / sum;
    shares.push_back(static_cast<std::int64_t>(exact));
    remainders.push_back(static_cast<double>(shares.back()) - exact);  // lowest first
    given += shares.back();
  }
  for (const std::int64_t i : LeastGraspable(remainders, total - given)) {
    ++shares[static_cast<std::size_t>(i)];
  }
  return shares;
}

SharedElites LeastGraspableByCell(const std::vector<double>& graspability,
                                  const std::vector<std::int64_t>& cell,
                                  const std::vector<double>& weight, std::int64_t keep) {
  AG_CHECK(cell.size() == graspability.size(), "one cell for each object");
  SharedElites shared;
  shared.missing = SharesOf(weight, keep);
  for (std::size_t c = 0; c < weight.size(); ++c) {
    std::vector<double> inside = graspability;
    for (std::size_t i = 0; i < cell.size(); ++i) {
      if (cell[i] != static_cast<std::int64_t>(c)) inside[i] = std::nan("");
    }
    const std::vector<std::int64_t> kept = LeastGraspable(inside, shared.missing[c]);
    shared.elites.insert(shared.elites.end(), kept.begin(), kept.end());
    shared.missing[c] -= static_cast<std::int64_t>(kept.size());
  }
  std::sort(shared.elites.begin(), shared.elites.end());
  return shared;
}

std::vector<std::int64_t> DominatedNovelty(const std::vector<double>& graspability,
                                           const DistanceMatrix& distances, std::int64_t keep,
                                           int neighbours) {
  AG_CHECK(distances.rows() == std::ssize(graspability) && distances.cols() == distances.rows(),
           "a distance for every pair of objects");
  AG_CHECK(neighbours > 0, "at least one neighbour");
  const std::vector<std::int64_t> ranked = LeastGraspableFirst(graspability);
  // Negative, so that the lowest is worth most.
  std::vector<double> order(graspability.size(), std::numeric_limits<double>::quiet_NaN());
  std::vector<float> away;
  for (std::size_t rank = 0; rank < ranked.size(); ++rank) {
    const std::int64_t i = ranked[rank];
    away.clear();
    for (std::size_t better = 0; better < rank; ++better) {
      away.push_back(distances(i, ranked[better]));
    }
    const auto count = std::min<std::ptrdiff_t>(std::ssize(away), neighbours);
    std::partial_sort(away.begin(), away.begin() + count, away.end());
    const double sum = std::accumulate(away.begin(), away.begin() + count, 0.0);
    order[static_cast<std::size_t>(i)] =
        count == 0 ? -std::numeric_limits<double>::infinity() : -sum / static_cast<double>(count);
  }
  return LeastGraspable(order, keep);
}

}  // namespace antigrasp
