#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "antigrasp/mesh/length_unit.h"
#include "antigrasp/mesh/triangle_mesh.h"

namespace antigrasp {

// What a mesh file says, before anything is believed: corners may refer to no vertex.
struct PolygonSoup {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::int64_t> corners;  // of all polygons, one after the other; 0 = first vertex
  std::vector<std::size_t> ends;      // polygon i is corners [ends[i - 1], ends[i])
  std::vector<std::string> notes;     // what had to be read otherwise than the file says
  std::optional<FileUnit> unit;       // of a file that knows it

  void EndPolygon() { ends.push_back(corners.size()); }
};

// Checks every coordinate and index, merges exactly equal positions (0 and -0 too), triangulates
// polygons. Vertices keep the order of their first use in the file. Faces of fewer than three
// corners are left out, with a line in `notes`, as long as another face is there. InputError names
// `path`.
TriangleMesh ToTriangleMesh(const PolygonSoup& soup, const std::string& path,
                            std::vector<std::string>* notes = nullptr);

// Triangles over the corners of one closed polygon in space, same winding, corners given as indices
// into `vertices`. Concave polygons and corners on a straight edge come out right (ear clipping in
// the plane of the polygon); a polygon that crosses itself gets some triangulation.
std::vector<std::array<std::int32_t, 3>> TriangulatedPolygon(
    const std::vector<Eigen::Vector3d>& vertices, const std::vector<std::int32_t>& polygon);

}  // namespace antigrasp
