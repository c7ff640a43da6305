#pragma once

#include <pybind11/pybind11.h>

#include <filesystem>
#include <string>
#include <vector>

#include "antigrasp/datasets/shape_set.h"
#include "antigrasp/python/mesh_object.h"

namespace antigrasp::python {

// antigrasp.ShapeSet: grids that lie behind one another, which do not change.
struct ShapesObject {
  ShapeSet about;             // all but the grids
  int n = 0;                  // nodes along a side
  std::vector<float> values;  // [N, n, n, n], x fastest

  std::size_t size() const { return about.names.size(); }
  SdfGrid Grid(std::size_t i) const;
};

ShapesObject ShapesOf(ShapeSet set);

// As a command reads the objects of an SDF file: those whose surface is no solid have a status that
// says so. `side`: by what they are scaled; 1 leaves them in the unit cube.
std::vector<MeshPointer> MeshesOf(const ShapesObject& shapes, double side, int threads);

void BindShapes(pybind11::module_& module);
void BindCompare(pybind11::module_& module);

}  // namespace antigrasp::python
