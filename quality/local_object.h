#pragma once

#include <Eigen/Core>
#include <optional>

#include "antigrasp/mesh/triangle_mesh.h"
#include "antigrasp/quality/metric_options.h"

namespace antigrasp {

// An object as the metric looks at it: in metres, about a round place near it (mesh/place.h). Far
// from the origin the last digits of contacts and normals would depend on the place.
struct LocalObject {
  TriangleMesh mesh;      // metres
  double scale = 1.0;     // metres per unit of the mesh that was given
  Eigen::Vector3d place;  // taken off that mesh before, its unit
};

// The mesh about `place`, then rescaled: exact but for the product.
TriangleMesh MetresAbout(const Eigen::Vector3d& place, const TriangleMesh& mesh, double scale);

// nullopt for an empty, non-finite or damaged mesh and for one without a size.
std::optional<LocalObject> MakeLocalObject(const TriangleMesh& mesh, const MetricOptions& options);

}  // namespace antigrasp
