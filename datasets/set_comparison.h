#pragma once

#include "antigrasp/datasets/chamfer.h"

namespace antigrasp {

// A set of samples against a reference set of the same size.
struct SetComparison {
  double coverage = 0.0;  // COV: share of the reference that is the nearest of some sample
  double matching = 0.0;  // MMD: mean distance from a reference shape to the nearest sample
  double nna = 0.0;  // 1-NNA: share of shapes whose nearest other shape, of both sets, is of their
                     // own set; 0.5 = indistinguishable, 1 = apart, 0 = copies
  // Mean distance to the nearest reference shape: of the samples, and of the reference itself
  // (leave one out).
  double to_reference = 0.0, within_reference = 0.0;
};

// COV and MMD as in Achlioptas et al., "Learning representations and generative models for 3D point
// clouds", ICML 2018; 1-NNA after Lopez-Paz and Oquab, "Revisiting classifier two-sample tests",
// ICLR 2017, and Yang et al., "PointFlow", ICCV 2019. Distances [n, n], n >= 2: samples among
// themselves, samples (rows) to reference, reference among themselves. Equal distances count
// against a shape's own set. O(n^2).
SetComparison CompareSets(const Eigen::Ref<const DistanceMatrix>& samples,
                          const Eigen::Ref<const DistanceMatrix>& between,
                          const Eigen::Ref<const DistanceMatrix>& reference);

// How far apart the shapes of one set are.
struct SetSpread {
  double duplicates = 0.0;     // share nearer to another shape of the set than `near`
  double mean_distance = 0.0;  // over all pairs
};
// `near` is half the median distance from a reference shape to the nearest other one.
struct SpreadComparison {
  SetSpread samples, reference;
  double diversity = 0.0;        // the samples' mean distance by the reference's; 0 if that is 0
  double median_distance = 0.0;  // over all pairs of the reference
};
// Each among themselves, at least two shapes; medians are the lower ones. O(n^2).
SpreadComparison CompareSpreads(const Eigen::Ref<const DistanceMatrix>& samples,
                                const Eigen::Ref<const DistanceMatrix>& reference);

// Distances without what two measurements of one shape are apart, floors[i] for shape i: sqrt(d^2 -
// f^2), at least 0, with the mean f of the pair. Points that miss each other by f along a surface
// and by d across it are sqrt(d^2 + f^2) apart.
DistanceMatrix WithoutFloors(const Eigen::Ref<const DistanceMatrix>& distances,
                             const std::vector<double>& floors);

// Number of different shapes in a set: exp of the entropy of the eigenvalues of K / n with
// K = exp(-d^2 / (2 scale^2)) (Friedman and Dieng, "The Vendi score", TMLR 2023).
// 1 for n equal shapes, n for shapes that are many scales apart; scale 0 counts the groups of equal
// shapes. Chamfer distances need not give a positive K: negative eigenvalues are left out, the
// others scaled to the sum 1. O(n^3): 0.1 s for 500.
double VendiScore(const Eigen::Ref<const DistanceMatrix>& distances, double scale);

}  // namespace antigrasp
