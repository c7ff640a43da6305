#include "antigrasp/datasets/chamfer.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "antigrasp/core/check.h"
#include "antigrasp/core/shared_stream.h"
#include "antigrasp/datasets/nearest_points.h"

namespace antigrasp {
namespace {

template <int D>
double MeanDistance(const PointBlocks<D>& from, const PointBlocks<D>& to) {
  thread_local std::vector<float> squared;
  NearestSquared(from, to, &squared);
  double sum = 0.0;
  for (std::size_t b = 0; b < from.blocks().size(); ++b) {
    for (std::size_t lane = 0; lane < from.blocks()[b].used; ++lane) {
      sum += std::sqrt(static_cast<double>(squared[b * PointBlocks<D>::kBlock + lane]));
    }
  }
  return sum / static_cast<double>(from.size());
}

}  // namespace

template <int D>
double Chamfer(const PointBlocks<D>& a, const PointBlocks<D>& b) {
  return 0.5 * (MeanDistance(a, b) + MeanDistance(b, a));
}

template double Chamfer(const PointSet&, const PointSet&);
template double Chamfer(const OrientedPointSet&, const OrientedPointSet&);

template <int D>
DistanceMatrix ChamferMatrix(const std::vector<PointBlocks<D>>& shapes, int threads,
                             const ProgressFn& progress, WorkShare* share) {
  const auto n = static_cast<std::int64_t>(shapes.size());
  DistanceMatrix matrix = DistanceMatrix::Zero(n, n);
  const auto add_row = [&](std::int64_t i, std::vector<float>* row) {
    for (std::int64_t j = i + 1; j < n; ++j) {
      row->push_back(static_cast<float>(
          Chamfer(shapes[static_cast<std::size_t>(i)], shapes[static_cast<std::size_t>(j)])));
    }
  };
  // A long row goes with a short one, so that all items cost the same and the time left is true.
  StreamShared(
      share, (n + 1) / 2, threads,
      [&](std::int64_t item) {
        std::vector<float> rows;
        add_row(item, &rows);
        if (n - 1 - item != item) add_row(n - 1 - item, &rows);
        return rows;
      },
      [&](std::int64_t item, const std::vector<float>& rows) {
        const auto length = static_cast<std::ptrdiff_t>(n - 1 - item);
        AG_CHECK(std::ssize(rows) == (n - 1 - item == item ? length : n - 1), "two rows");
        std::copy(rows.begin(), rows.begin() + length, &matrix(item, 0) + item + 1);
        std::copy(rows.begin() + length, rows.end(), &matrix(n - 1 - item, 0) + n - item);
      },
      progress);
  for (std::int64_t i = 0; i < n; ++i) {
    for (std::int64_t j = 0; j < i; ++j) matrix(i, j) = matrix(j, i);
  }
  return matrix;
}

template DistanceMatrix ChamferMatrix(const std::vector<PointSet>&, int, const ProgressFn&,
                                      WorkShare*);
template DistanceMatrix ChamferMatrix(const std::vector<OrientedPointSet>&, int, const ProgressFn&,
                                      WorkShare*);

std::vector<double> NearestChamfer(const std::vector<PointSet>& shapes,
                                   const std::vector<PointSet>& others, int threads,
                                   const ProgressFn& progress, WorkShare* share) {
  AG_CHECK(!others.empty(), "at least one other shape");
  std::vector<double> nearest(shapes.size());
  StreamShared(
      share, std::ssize(shapes), threads,
      [&](std::int64_t i) {
        double least = std::numeric_limits<double>::infinity();
        for (const PointSet& other : others) {
          least = std::min(least, Chamfer(shapes[static_cast<std::size_t>(i)], other));
        }
        return least;
      },
      [&](std::int64_t i, double least) { nearest[static_cast<std::size_t>(i)] = least; },
      progress);
  return nearest;
}

}  // namespace antigrasp
