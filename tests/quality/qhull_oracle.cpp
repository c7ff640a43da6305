#include "tests/quality/qhull_oracle.h"

#include <algorithm>
#include <cstdio>
#include <limits>

extern "C" {
#include <libqhull_r/qhull_ra.h>
}

namespace antigrasp {

double HullDepthByQhull(const Eigen::Matrix<double, 6, Eigen::Dynamic>& wrenches) {
  Eigen::Matrix<double, 6, Eigen::Dynamic> points = wrenches;
  qhT state;
  qhT* qh = &state;
  qh_zero(qh, nullptr);
  std::FILE* silent = std::fopen("/dev/null", "w");
  char options[] = "qhull Qt";
  const int failed = qh_new_qhull(qh, 6, static_cast<int>(points.cols()), points.data(), False,
                                  options, nullptr, silent);
  double depth = std::numeric_limits<double>::quiet_NaN();
  if (failed == 0) {
    depth = std::numeric_limits<double>::infinity();
    facetT* facet;
    FORALLfacets { depth = std::min(depth, -facet->offset); }
  }
  qh_freeqhull(qh, qh_ALL);
  int leaked_blocks = 0, leaked_bytes = 0;
  qh_memfreeshort(qh, &leaked_blocks, &leaked_bytes);
  std::fclose(silent);
  return depth;
}

}  // namespace antigrasp
