#pragma once

#include <vector>

#include "antigrasp/datasets/point_set.h"

namespace antigrasp {

// For each lane of each block of `from` the squared distance to the nearest point of `to`, in
// float32: the smallest of (dx dx + dy dy) + dz dz + ... over all points, bit for bit, whatever the
// instruction set. Lanes that are not `used` have values too. O(blocks^2) boxes, and points only
// where boxes are near.
template <int D>
void NearestSquared(const PointBlocks<D>& from, const PointBlocks<D>& to,
                    std::vector<float>* squared);

}  // namespace antigrasp
