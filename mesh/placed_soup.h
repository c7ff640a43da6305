#pragma once

#include <Eigen/Geometry>
#include <string>

#include "antigrasp/mesh/polygon_soup.h"

namespace antigrasp {

// Appends a part where `place` puts it; one that is mirrored is wound the other way, so that
// outside stays outside. InputError, naming `path` and `name`, for a corner that refers to no
// vertex of the part itself, and when there are more than ten million faces: a small file can place
// a part so often that it fills the memory.
void AppendPlaced(const PolygonSoup& part, const Eigen::Affine3d& place, const std::string& name,
                  const std::string& path, PolygonSoup* soup);

}  // namespace antigrasp
