// antigrasp.epsilon.
#include <cmath>

#include "antigrasp/python/arrays.h"
#include "antigrasp/python/bindings.h"
#include "antigrasp/python/contact_arrays.h"
#include "antigrasp/python/errors.h"
#include "antigrasp/quality/contact_table.h"

namespace antigrasp::python {
namespace {

constexpr const char* kEpsilonName = "epsilon";

// The shape of the grasps: what stands before (2, 3) in the points.
std::vector<py::ssize_t> ShapeOfGrasps(const Doubles& points) {
  const py::ssize_t n = points.ndim();
  if (n < 2 || points.shape(n - 1) != 3 || points.shape(n - 2) != 2) {
    throw InputError("points of shape " + ShapeText(points), kEpsilonName,
                     "an array of shape (..., 2, 3)");
  }
  return {points.shape(), points.shape() + n - 2};
}

// That the array has the grasps' shape and then `more`.
void RequireShape(const Doubles& array, const char* name, std::vector<py::ssize_t> shape,
                  const std::vector<py::ssize_t>& more) {
  shape.insert(shape.end(), more.begin(), more.end());
  if (std::vector<py::ssize_t>(array.shape(), array.shape() + array.ndim()) == shape) return;
  throw InputError(std::string(name) + " of shape " + ShapeText(array), kEpsilonName,
                   "that of points: " + ShapeText(py::array_t<char>(shape)));
}

// Of those of a table of contacts what epsilon makes use of.
std::vector<Option> ContactConstants(ContactTableOptions* options) {
  OptionTable table;
  Bind(&table, options);
  std::vector<Option> constants = table.options();
  std::erase_if(constants, [](const Option& o) { return !o.key.starts_with("contact."); });
  return constants;
}

WrenchModel ModelOf(const py::dict& constants) {
  ContactTableOptions options;
  OptionTable table;
  Bind(&table, &options);
  Keywords(constants, ContactConstants(&options), kEpsilonName).Apply(&table);
  return {options.friction, options.cone_edges, options.finger_radius, options.torque_scale,
          options.torsion};
}

py::object EpsilonOf(const py::object& points_given, const py::object& normals_given,
                     const py::object& com_given, const py::object& friction,
                     const py::object& closing_given, int threads, const py::kwargs& constants) {
  const Doubles points = NumbersOf(points_given, "points", kEpsilonName, "an array (..., 2, 3)");
  const std::vector<py::ssize_t> shape = ShapeOfGrasps(points);
  const Doubles normals = NumbersOf(normals_given, "normals", kEpsilonName, "an array (..., 2, 3)");
  RequireShape(normals, "normals", shape, {2, 3});
  const Doubles com = NumbersOf(com_given, "com", kEpsilonName, "an array (3,) or (..., 3)");
  ContactArrays contacts;
  contacts.com_each = com.ndim() != 1;
  RequireShape(com, "com", contacts.com_each ? shape : std::vector<py::ssize_t>{}, {3});
  Doubles frictions, closing;
  if (!friction.is_none()) {
    frictions = NumbersOf(friction, "friction", kEpsilonName, "a number, or one a grasp");
    if (frictions.ndim() == 0) {
      constants["friction"] = py::float_(*frictions.data());
    } else {
      RequireShape(frictions, "friction", shape, {});
      contacts.frictions = frictions.data();
    }
  }
  if (!closing_given.is_none()) {
    closing = NumbersOf(closing_given, "closing", kEpsilonName, "an array (..., 2, 3)");
    RequireShape(closing, "closing", shape, {2, 3});
    contacts.closings = closing.data();
  }
  contacts.count = points.size() / 6;
  contacts.points = points.data();
  contacts.normals = normals.data();
  contacts.coms = com.data();
  contacts.model = ModelOf(constants);
  py::array_t<double> epsilons(shape);
  const std::span<double> out(epsilons.mutable_data(), static_cast<std::size_t>(contacts.count));
  {
    const py::gil_scoped_release released;
    RequireContacts(contacts);
    EpsilonOfAll(contacts, threads, out, ListenToPython());
  }
  return shape.empty() ? py::object(py::float_(out[0])) : epsilons;
}

}  // namespace

void BindEpsilon(py::module_& module) {
  ContactTableOptions defaults;
  const std::string about =
      R"(Epsilon (Ferrari and Canny, L1) of any number of grasps of two soft contacts.

points: array (..., 2, 3); normals: the same shape, OUTWARD, of any length; com: (3,) or (..., 3);
friction: a number or an array (...); closing: (..., 2, 3), the direction each jaw closes in: one
that slips gives no force (without it both press with 1). float64 in C order is read where it lies.
threads: 0 = all. Returns an array (...), a float for one grasp; 0: no force closure. Lengths are
in one unit, metres with these defaults.
InputError for shapes that do not fit and for rows that are not finite, the first one named.

Constants and defaults:
)" + HelpOf(ContactConstants(&defaults));
  module.def("epsilon", &EpsilonOf, py::arg("points"), py::arg("normals"), py::arg("com"),
             py::arg("friction") = py::none(), py::kw_only(), py::arg("closing") = py::none(),
             py::arg("threads") = 0, about.c_str());
}

}  // namespace antigrasp::python
