#pragma once

#include <pybind11/numpy.h>

#include <Eigen/Core>
#include <string>
#include <vector>

#include "antigrasp/mesh/triangle_mesh.h"

namespace antigrasp::python {

namespace py = pybind11;

// NumPy arrays that are read where they lie if they are float64 in C order, else copied once.
using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;

// What there is to look at in memory that `owner` keeps alive, as a read-only array: no copy.
// Strides in bytes.
template <typename T>
py::array_t<T> ViewOf(const T* data, std::vector<py::ssize_t> shape,
                      std::vector<py::ssize_t> strides, py::handle owner) {
  py::array_t<T> view(std::move(shape), std::move(strides), data, owner);
  view.attr("setflags")(py::arg("write") = false);
  return view;
}

// A copy [n], [3] and [3, 3].
py::array_t<double> ArrayOf(const std::vector<double>& values);
py::array_t<double> ArrayOf(const Eigen::Vector3d& vector);
py::array_t<double> ArrayOf(const Eigen::Matrix3d& matrix);  // by rows

// The array as numbers. InputError that names `what`, `where` and the shape that was `expected`
// when it is none, or holds something that is no number.
Doubles NumbersOf(py::handle array, const std::string& what, const std::string& where,
                  const std::string& expected);
std::string ShapeText(const py::array& array);  // "(2, 3)"

// A mesh of arrays [V, 3] and [F, 3]. InputError for other shapes, for indices that are no whole
// numbers or out of range, for no faces and for what is not finite.
TriangleMesh MeshOfArrays(py::handle vertices, py::handle faces, const std::string& name);

}  // namespace antigrasp::python
