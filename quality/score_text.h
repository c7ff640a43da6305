#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "antigrasp/core/statistics.h"
#include "antigrasp/quality/graspability.h"

// Lines about scores, for people.
namespace antigrasp {

// The difference that a change made to one object, which says nothing about other objects, with its
// interval over grasps.
struct PairDifference {
  double difference = 0.0;
  Interval interval;
};
PairDifference DifferenceOf(const Graspability& changed, const Graspability& original,
                            const MetricOptions& metric);
// "paired difference -0.00050, 95 % interval over its grasps -0.00060 to -0.00040, -25.8 % (-30.9
// to -20.6) of the baseline's 0.00194, 1 pairs".
std::string PairText(const PairDifference& pair, double baseline);

// The same of several pairs, graspabilities in the same order, with the interval over objects; of
// the pairs that both have a score (not NaN).
std::string PairsText(const std::vector<double>& changed, const std::vector<double>& originals);

// The interval over grasps of a set's only score: "95 % interval over its grasps 0.00141 to
// 0.00155, -4.1 to +5.4 %".
std::string IntervalText(const Graspability& score);

// "3 objects scored, 1 not: mean graspability 0.00194 +-0.00012 (95 %), each scaled to a smallest
// extent of 40 mm"; NaN for an object without a score.
std::string MeanScoreText(const std::vector<double>& scores, const MetricOptions& metric);

// Beside the sets of quality/known_scores.h: "harder to grasp than 71 % of cylinders, ...", or that
// there are none at these constants. `mean`: it is that of several objects.
std::string KnownText(double graspability, bool mean, const MetricOptions& metric);

// "4: a.stl, b.stl, c.stl and 1 more".
std::string FirstNames(const std::vector<std::string>& names);

// That objects meet the same draws because they share a random stream, as in a data set of folders
// in which all have one name; "" where all have their own.
std::string SharedDrawsText(const std::vector<std::uint64_t>& streams);

}  // namespace antigrasp
