#pragma once

#include "antigrasp/mesh/triangle_mesh.h"
#include "tests/support/contact_shapes.h"
#include "tests/support/shapes.h"

// Solids with dents that are known on paper. Metres; away from the origin.
namespace antigrasp::shapes {

inline TriangleMesh Away(const TriangleMesh& mesh) {
  return Transformed(mesh, 1.0, Eigen::Vector3d(0.01, -0.02, 0.03));
}

// 40 x 40 x 20 mm less a notch of 20 x 20 mm: 24 cm3, hull 28 cm3.
inline TriangleMesh LShape() {
  return Away(Extruded({{0, 0}, {.04, 0}, {.04, .02}, {.02, .02}, {.02, .04}, {0, .04}},
                       {{{0, 1, 2}}, {{0, 2, 3}}, {{0, 3, 4}}, {{0, 4, 5}}}, 0.02));
}

// 60 x 60 x 20 mm with a slot 20 mm wide and 40 mm deep from the top, open at both faces: 56 cm3,
// hull 72 cm3.
inline TriangleMesh UShape() {
  return Away(Extruded(
      {{0, 0}, {.06, 0}, {.06, .06}, {.04, .06}, {.04, .02}, {.02, .02}, {.02, .06}, {0, .06}},
      {{{0, 1, 4}}, {{1, 2, 3}}, {{1, 3, 4}}, {{0, 4, 5}}, {{0, 5, 6}}, {{0, 6, 7}}}, 0.02));
}

}  // namespace antigrasp::shapes
