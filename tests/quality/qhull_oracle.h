#pragma once

#include <Eigen/Core>

namespace antigrasp {

// Distance from the origin to the hull of the columns by Qhull (option Qt, never QJ), the largest
// facet offset; not above 0 unless the origin is inside. NaN when Qhull finds no hull of full
// dimension.
double HullDepthByQhull(const Eigen::Matrix<double, 6, Eigen::Dynamic>& wrenches);

}  // namespace antigrasp
