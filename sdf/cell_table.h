#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace antigrasp {

// A marching-cubes cell. Corner c lies at (c & 1, c >> 1 & 1, c >> 2 & 1). Edge e runs along axis
// a = e / 4 from corner CellEdgeLow(e) to CellEdgeLow(e) + (1 << a). Bit c of a case is set when
// corner c is inside.
inline constexpr int kCellEdges = 12;
inline constexpr int kCellCases = 256;

constexpr int CellEdgeLow(int edge) {
  const int axis = edge / 4;
  return (edge & 1) << ((axis + 1) % 3) | (edge >> 1 & 1) << ((axis + 2) % 3);
}

using CellTriangle = std::array<std::uint8_t, 3>;  // three edges, counter-clockwise from outside
using CellLoop = std::vector<std::uint8_t>;        // a closed contour over the cell's faces

// The contours of a case. On a face with two opposite corners inside, the inside corners are always
// separated, whichever cell looks at the face: neighbouring cells agree and the surface is closed.
std::vector<CellLoop> TraceCellLoops(int cell_case);

// True when the two edges lie on one face of the cell.
bool ShareCellFace(int edge_a, int edge_b);

// The triangles of each of the 256 cases, made once (tens of milliseconds) and then shared. No
// diagonal lies on a face of the cell, so a cell meets its neighbours in the contours only; and the
// triangles of one cell do not touch each other wherever the crossings lie along their edges.
const std::array<std::vector<CellTriangle>, kCellCases>& CellTable();

}  // namespace antigrasp
