#pragma once

#include "antigrasp/core/options.h"
#include "antigrasp/mesh/triangle_mesh.h"

namespace antigrasp {

// A flat part from a CAD program has few and large faces: too few corners to move. More of them,
// with the same surface.
struct SubdivideOptions {
  // Longest edge, percent of the bounding-box diagonal; 0 = kFineEdge where the mesh is coarse,
  // else as it is; kAsItIs = never.
  double longest = 100.0;
};
inline constexpr double kAsItIs = 100.0;  // no edge is longer than the diagonal
inline constexpr double kFineEdge = 4.0;  // a cube: 6,144 faces
inline constexpr double kCoarseEdge = 25.0;
inline constexpr double kLeastEdge = 0.5;                  // a cube: about 400,000 faces
void Bind(OptionTable* table, SubdivideOptions* options);  // key "perturb.subdivide"
// InputError for what the table cannot refuse: a length between 0 and kLeastEdge.
void RequireSubdivision(const SubdivideOptions& options, const std::string& origin);

double LongestEdge(const TriangleMesh& mesh);  // 0 without faces
// Whether an edge is longer than kCoarseEdge percent of the diagonal.
bool IsCoarse(const TriangleMesh& mesh);

// Splits the longest edge in its middle, with the faces on either side of it, until none is longer
// than `longest` (> 0). The surface, its volume and its creases stay what they are, up to the last
// digit of a middle; no angle falls below half of the smallest one that there was (Rosenberg and
// Stenger 1975). Closed, manifold and oriented (CHECKed). 4 ms for 6,000 faces.
TriangleMesh SplitLongEdges(const TriangleMesh& mesh, double longest);

// The mesh as the options want it.
TriangleMesh Subdivided(const TriangleMesh& mesh, const SubdivideOptions& options);

}  // namespace antigrasp
