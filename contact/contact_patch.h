#pragma once

#include <Eigen/Core>
#include <vector>

namespace antigrasp {

// A contact on a flat surface (the front of a pad, a table), metres, in the surface's frame: x away
// from it, towards the object, y and z in it.
struct PatchPoint {
  Eigen::Vector2d place;   // y, z
  Eigen::Vector3d normal;  // unit, into the object
  double distance;
  bool lowest =
      true;        // no surface beside it is nearer: a bump's top, a corner, all of a flush face
  double x = 0.0;  // below 0: of a side of the pad, so far behind its front face
};

// At most `most` of the points, which carry the load and keep the patch's extent. Outlines (corners
// of the hull) in this order, as long as there is room: of the deepest points, of the lowest ones
// within 20 um of them (what yields by that much bears on these too), with `all_ends` of all that
// overlap (a ridge across the pad bears at both of its ends, though one is deeper), of all lowest
// ones, of all. Corners that stand out by less than a micrometre are none, and two within 20 um are
// the deeper one. Where an outline has too many corners, the one that stands out least goes first.
// The answer does not depend on the order of the points, nor on how many there are inside. n log n.
std::vector<PatchPoint> PatchCorners(std::vector<PatchPoint> points, int most,
                                     bool all_ends = false);

}  // namespace antigrasp
