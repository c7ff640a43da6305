#pragma once

#include <array>
#include <cstdint>

namespace antigrasp {

// Exact triangle tests in integer coordinates, for choosing the triangulations of a marching-cubes
// cell. Coordinates must stay below 2^14 in size, so that no product overflows 64 bits.
using IntPoint = std::array<std::int64_t, 3>;
using IntTriangle = std::array<IntPoint, 3>;

// Six times the signed volume of the tetrahedron a, b, c, d.
std::int64_t Orient(const IntPoint& a, const IntPoint& b, const IntPoint& c, const IntPoint& d);

bool IsDegenerate(const IntTriangle& t);  // zero area

// Whether the closed segment p-q has a point in common with the closed triangle (area > 0).
bool SegmentTouches(const IntPoint& p, const IntPoint& q, const IntTriangle& t);

// Whether two triangles of a surface meet anywhere but in the corners that they share (equal
// points): touching counts, and so does a fold that puts two neighbours on top of each other.
bool Crosses(const IntTriangle& s, const IntTriangle& t);

}  // namespace antigrasp
