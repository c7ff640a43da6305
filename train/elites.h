#pragma once

#include <cstdint>
#include <vector>

#include "antigrasp/core/rng.h"
#include "antigrasp/datasets/chamfer.h"

namespace antigrasp {

// The `keep` objects with the lowest graspability, as ascending indices (V-B, VI-C). NaN marks a
// rejected object and is never kept; ties go to the lower index; fewer valid objects: all of them.
std::vector<std::int64_t> LeastGraspable(const std::vector<double>& graspability,
                                         std::int64_t keep);

// Uniform random numbers in place of the graspability, NaN where that is NaN: the least of them are
// a random draw of valid objects (the control).
std::vector<double> RandomOrder(const std::vector<double>& graspability, RngStream* rng);

// Elites shared out over cells.
struct SharedElites {
  std::vector<std::int64_t> elites;   // ascending indices of objects
  std::vector<std::int64_t> missing;  // per cell: the part of its share that no valid object filled
};

// `total` shared out in proportion to `weight` (weights >= 0, not all 0): largest remainders, ties
// to the lower index.
std::vector<std::int64_t> SharesOf(const std::vector<double>& weight, std::int64_t total);

// `keep` is shared out over the cells in proportion to `weight`, and each cell keeps the least
// graspable of its own: one elite archive cell by cell, as in MAP-Elites (Mouret & Clune 2015),
// with the prior's density as capacity. cell[i] in [0, weight.size()); weights >= 0, not all 0.
SharedElites LeastGraspableByCell(const std::vector<double>& graspability,
                                  const std::vector<std::int64_t>& cell,
                                  const std::vector<double>& weight, std::int64_t keep);

// Dominated Novelty Search (Bahlous-Boldi et al. 2025): an object is worth its mean distance to the
// `neighbours` nearest of those that are less graspable, infinitely much without any. Kept are the
// `keep` that are worth most, as ascending indices: the least graspable one, and those that are
// unlike everything that beats them. Ties, of graspability and of worth, go to the lower index; NaN
// is never kept. distances: [N, N], its diagonal is not looked at. N^2 log N.
std::vector<std::int64_t> DominatedNovelty(const std::vector<double>& graspability,
                                           const DistanceMatrix& distances, std::int64_t keep,
                                           int neighbours);

}  // namespace antigrasp
