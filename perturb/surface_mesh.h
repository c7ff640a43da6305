#pragma once

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include "antigrasp/mesh/triangle_mesh.h"

namespace antigrasp {

// CGAL's mesh with neighbours, for what changes a mesh's faces. Slow to compile: for .cpp files.
using SurfaceKernel = CGAL::Simple_cartesian<double>;
using SurfaceMesh = CGAL::Surface_mesh<SurfaceKernel::Point_3>;

SurfaceMesh ToSurfaceMesh(const TriangleMesh& mesh);  // manifold and oriented (CHECKed)

// Vertices and faces in the order of their indices, those that were removed left out.
TriangleMesh FromSurfaceMesh(SurfaceMesh* mesh);

}  // namespace antigrasp
