#include "antigrasp/python/arrays.h"

#include <cmath>
#include <cstring>
#include <limits>

#include "antigrasp/core/error.h"

namespace antigrasp::python {
namespace {

using Indices = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>;

bool HasColumns(const py::array& array, py::ssize_t columns) {
  return array.ndim() == 2 && array.shape(1) == columns;
}

// Whole numbers of any type; floats were cut otherwise.
Indices IndicesOf(py::handle faces, const std::string& name) {
  const auto given = py::array::ensure(faces);
  if (!given || !HasColumns(given, 3)) {
    PyErr_Clear();
    throw InputError("faces" + (given ? " of shape " + ShapeText(given) : std::string()), name,
                     "an array of shape (F, 3)");
  }
  const char kind = given.dtype().kind();
  if (kind != 'i' && kind != 'u') {
    throw InputError("faces of type " + std::string(py::str(given.dtype())), name,
                     "whole numbers: places in the vertices, from 0");
  }
  return Indices(given);
}

}  // namespace

py::array_t<double> ArrayOf(const std::vector<double>& values) {
  return py::array_t<double>(static_cast<py::ssize_t>(values.size()), values.data());
}

py::array_t<double> ArrayOf(const Eigen::Vector3d& vector) {
  return py::array_t<double>(3, vector.data());
}

py::array_t<double> ArrayOf(const Eigen::Matrix3d& matrix) {
  py::array_t<double> array({3, 3});
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) array.mutable_at(row, column) = matrix(row, column);
  }
  return array;
}

std::string ShapeText(const py::array& array) { return py::str(array.attr("shape")); }

Doubles NumbersOf(py::handle array, const std::string& what, const std::string& where,
                  const std::string& expected) {
  auto numbers = Doubles::ensure(array);
  if (numbers) return numbers;
  PyErr_Clear();
  throw InputError(what + " that are no numbers", where, expected);
}

TriangleMesh MeshOfArrays(py::handle vertices, py::handle faces, const std::string& name) {
  const char* const kVertices = "an array of shape (V, 3)";
  const Doubles points = NumbersOf(vertices, "vertices", name, kVertices);
  if (!HasColumns(points, 3)) {
    throw InputError("vertices of shape " + ShapeText(points), name, kVertices);
  }
  const Indices corners = IndicesOf(faces, name);
  constexpr auto kMost = std::numeric_limits<std::int32_t>::max();
  if (points.shape(0) > kMost || corners.shape(0) > kMost) {
    throw InputError("more than " + std::to_string(kMost) + " vertices or faces", name, "fewer");
  }
  if (corners.shape(0) == 0) throw InputError("no faces", name, "at least one");
  TriangleMesh mesh;
  mesh.vertices.resize(static_cast<std::size_t>(points.shape(0)));
  mesh.faces.resize(static_cast<std::size_t>(corners.shape(0)));
  for (py::ssize_t i = 0; i < points.shape(0); ++i) {
    Eigen::Vector3d& vertex = mesh.vertices[static_cast<std::size_t>(i)];
    vertex = {points.at(i, 0), points.at(i, 1), points.at(i, 2)};
    if (!vertex.allFinite()) {
      throw InputError("vertex " + std::to_string(i) + " is not finite", name, "finite numbers");
    }
  }
  for (py::ssize_t i = 0; i < corners.shape(0); ++i) {
    for (py::ssize_t k = 0; k < 3; ++k) {
      const std::int64_t corner = corners.at(i, k);
      if (corner < 0 || corner >= points.shape(0)) {
        throw InputError("face " + std::to_string(i) + " names vertex " + std::to_string(corner),
                         name, "0 to " + std::to_string(points.shape(0) - 1));
      }
      mesh.faces[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)] =
          static_cast<std::int32_t>(corner);
    }
  }
  return mesh;
}

}  // namespace antigrasp::python
