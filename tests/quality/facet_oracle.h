#pragma once

#include <Eigen/Core>

namespace antigrasp {

// Distance from the origin to the hull of the columns by trying every 6 of them as a facet: slow
// (count choose 6), but with nothing in common with the code under test. 0 unless the origin is
// inside. The hull must be full-dimensional.
double EpsilonByFacets(const Eigen::Matrix<double, 6, Eigen::Dynamic>& wrenches);

}  // namespace antigrasp
