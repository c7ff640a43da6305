#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "antigrasp/mesh/triangle_mesh.h"

// Solids that a fingertip is set against.
namespace antigrasp::shapes {

// A prism over a polygon of the plane (counter-clockwise; it may have notches), from -height / 2 to
// height / 2 along z. The triangles (counter-clockwise too) say how the polygon is covered.
TriangleMesh Extruded(const std::vector<Eigen::Vector2d>& polygon,
                      const std::vector<std::array<int, 3>>& triangles, double height);

// Each face cut into four, `times` times; the surface stays where it is.
TriangleMesh Subdivided(const TriangleMesh& mesh, int times);

// A sphere whose corners are moved in or out by at most a tenth of the radius, at random: hills,
// valleys and dents of facets, nowhere through itself.
TriangleMesh Bumpy(double radius, int subdivisions, std::uint64_t seed);

}  // namespace antigrasp::shapes
