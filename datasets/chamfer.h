#pragma once

#include <Eigen/Core>
#include <vector>

#include "antigrasp/core/parallel.h"
#include "antigrasp/core/work_share.h"
#include "antigrasp/datasets/point_set.h"

namespace antigrasp {

// Square or rectangular, row i = shape i.
using DistanceMatrix = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// Chamfer distance of two point sets: half the sum of the mean distance from a point of `a` to its
// nearest in `b` and of the same from `b` to `a`. Distances, NOT squared (the point clouds of Fan
// et al., "A point set generation network", CVPR 2017, and of PointFlow, Yang et al., ICCV 2019,
// square them, which lets a few outliers rule): the unit is that of the points, and a shape moved
// by a small step is that step's normal part away. Exact, symmetric, 0 for equal sets. Two
// samplings of one surface are not 0 apart but about 0.5 sqrt(area / points). The nearest points
// come from blocks with boxes; 1,024 points against 1,024 take 0.15 to 0.2 ms.
// D: 3, or 6 with normals (OrientedPointSet), where the distances are those of six coordinates.
template <int D>
double Chamfer(const PointBlocks<D>& a, const PointBlocks<D>& b);

// All pairs of the shapes: symmetric, zeros on the diagonal, the same bytes at any thread count.
// The ranks of `share` fill it together; on one that helps it stays zero.
template <int D>
DistanceMatrix ChamferMatrix(const std::vector<PointBlocks<D>>& shapes, int threads,
                             const ProgressFn& progress = nullptr, WorkShare* share = nullptr);

// For each shape the distance to the nearest one of `others` (at least one); shared as the matrix.
std::vector<double> NearestChamfer(const std::vector<PointSet>& shapes,
                                   const std::vector<PointSet>& others, int threads,
                                   const ProgressFn& progress = nullptr,
                                   WorkShare* share = nullptr);

}  // namespace antigrasp
