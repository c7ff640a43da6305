// antigrasp.Mesh, Inspection and StablePoses.
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>

#include "antigrasp/core/error.h"
#include "antigrasp/mesh/inspect.h"
#include "antigrasp/mesh/pose_table.h"
#include "antigrasp/python/arrays.h"
#include "antigrasp/python/errors.h"
#include "antigrasp/python/mesh_object.h"

namespace antigrasp::python {
namespace {

MeshPointer MeshOfFile(const py::object& path, const std::optional<std::string>& name) {
  const std::string file = py::module_::import("os").attr("fspath")(path).cast<std::string>();
  const py::gil_scoped_release released;
  return std::make_shared<MeshObject>(
      name.value_or(std::filesystem::path(file).filename().string()), ReadMeshFile(file));
}

MeshPointer MakeMesh(const py::object& first, const py::object& faces,
                     const std::optional<std::string>& name) {
  const std::string named = name.value_or("mesh");
  const auto of_arrays = [&](py::handle vertices, py::handle corners) {
    return std::make_shared<MeshObject>(
        named, MeshFile{MeshOfArrays(vertices, corners, named), std::nullopt, {}});
  };
  if (!faces.is_none()) return of_arrays(first, faces);
  if (py::isinstance<py::str>(first) || py::hasattr(first, "__fspath__")) {
    return MeshOfFile(first, name);
  }
  if (py::hasattr(first, "vertices") && py::hasattr(first, "faces")) {
    return of_arrays(first.attr("vertices"), first.attr("faces"));
  }
  throw InputError("a mesh of " + std::string(py::str(py::type::handle_of(first))), named,
                   "vertices and faces, a file, or an object that has both, as trimesh's");
}

py::array_t<double> Vertices(const py::object& self) {
  const auto& mesh = self.cast<const MeshObject&>().mesh();
  const auto rows = static_cast<py::ssize_t>(mesh.vertices.size());
  return ViewOf(mesh.vertices.empty() ? nullptr : mesh.vertices.front().data(), {rows, 3},
                {sizeof(Eigen::Vector3d), sizeof(double)}, self);
}

py::array_t<std::int32_t> Faces(const py::object& self) {
  const auto& mesh = self.cast<const MeshObject&>().mesh();
  const auto rows = static_cast<py::ssize_t>(mesh.faces.size());
  return ViewOf(mesh.faces.empty() ? nullptr : mesh.faces.front().data(), {rows, 3},
                {3 * sizeof(std::int32_t), sizeof(std::int32_t)}, self);
}

std::string MeshRepr(const MeshObject& self) {
  return "<antigrasp.Mesh " + self.name() + ": " + std::to_string(self.mesh().vertices.size()) +
         " vertices, " + std::to_string(self.mesh().faces.size()) + " faces>";
}

py::array_t<double> BoundsArray(const MeshObject& self) {
  const BoundingBox box = Bounds(self.mesh());
  py::array_t<double> bounds({2, 3});
  for (int axis = 0; axis < 3; ++axis) {
    bounds.mutable_at(0, axis) = box.min[axis];
    bounds.mutable_at(1, axis) = box.max[axis];
  }
  return bounds;
}

struct PoseSet {  // no list to pybind11
  std::vector<StablePose> poses;
};

PoseSet StablePosesOfMesh(const MeshObject& self) {
  const MeshObject::Shared object = self.Usable();
  return {StablePosesOf(object->mesh, object->ok())};
}

py::array_t<double> Rotations(const py::object& self) {
  const auto& poses = self.cast<const PoseSet&>().poses;
  constexpr py::ssize_t kNumber = sizeof(double);  // Eigen's columns come first
  return ViewOf(poses.empty() ? nullptr : poses.front().table_from_object.data(),
                {static_cast<py::ssize_t>(poses.size()), 3, 3},
                {sizeof(StablePose), kNumber, 3 * kNumber}, self);
}

template <double StablePose::*Field>
py::array_t<double> OfPoses(const py::object& self) {
  const auto& poses = self.cast<const PoseSet&>().poses;
  return ViewOf(poses.empty() ? nullptr : &(poses.front().*Field),
                {static_cast<py::ssize_t>(poses.size())}, {sizeof(StablePose)}, self);
}

void BindInspection(py::module_& module) {
  py::class_<MeshReport>(module, "Inspection",
                         "What a mesh is, in trimesh's words. Lengths in the unit of the mesh.")
      .def_readonly("closed", &MeshReport::closed, "every edge has exactly two faces (watertight)")
      .def_readonly("manifold", &MeshReport::manifold, "and every vertex one fan of faces")
      .def_readonly("orientable", &MeshReport::orientable, "faces can be turned to agree")
      .def_readonly("oriented", &MeshReport::oriented, "they do agree (winding consistent)")
      .def_readonly("outward", &MeshReport::outward, "closed, oriented and facing outward")
      .def_readonly("self_intersecting", &MeshReport::self_intersecting, "faces cross each other")
      .def_readonly("degenerate_faces", &MeshReport::degenerate_faces, "faces without area")
      .def_readonly("components", &MeshReport::components, "pieces, connected by edges")
      .def_readonly("voids", &MeshReport::voids, "of them: hollows")
      .def_readonly("boundary_edges", &MeshReport::boundary_edges, "edges with one face")
      .def_readonly("nonmanifold_edges", &MeshReport::nonmanifold_edges, "with more than two")
      .def_readonly("genus", &MeshReport::genus, "of a closed single piece, else 0")
      .def_readonly("volume", &MeshReport::volume, "signed")
      .def_readonly("area", &MeshReport::area)
      .def_property_readonly(
          "center_of_mass", [](const MeshReport& self) { return ArrayOf(self.center_of_mass); },
          "array (3,)")
      .def_property_readonly("is_solid", &MeshReport::IsSolid, "usable without repair")
      .def_property_readonly("problem", &WhyNotSolid, "why it is no solid; '' when it is one")
      .def("__repr__", [](const MeshReport& self) {
        const std::string why = WhyNotSolid(self);
        return "<antigrasp.Inspection: " + (why.empty() ? "a solid" : why) + ">";
      });
}

void BindPoses(py::module_& module) {
  py::class_<PoseSet>(module, "StablePoses",
                      "The ways in which an object comes to rest on a table, the likeliest first.")
      .def("__len__", [](const PoseSet& self) { return self.poses.size(); })
      .def_property_readonly("rotations", &Rotations,
                             "array (P, 3, 3): from the object to the table; row 2 is up, in the "
                             "object's frame")
      .def_property_readonly("probabilities", &OfPoses<&StablePose::probability>, "array (P,)")
      .def_property_readonly("com_heights", &OfPoses<&StablePose::com_height>,
                             "array (P,): the centre of mass above the table, unit of the mesh");
}

}  // namespace

void BindMesh(py::module_& module) {
  BindInspection(module);
  BindPoses(module);
  using Released = py::call_guard<py::gil_scoped_release>;
  py::class_<MeshObject, MeshPointer>(module, "Mesh",
                                      R"(A triangle mesh, which does not change.

Mesh(vertices, faces): arrays (V, 3) of numbers and (F, 3) of whole numbers, counter-clockwise
seen from outside; Mesh(path): STL, OBJ, PLY, OFF, 3MF, GLB or DAE; Mesh(object): what has
vertices and faces, as trimesh's meshes. The unit is the mesh's own: the metric rescales objects,
or is told (Metric(true_size=True, units="mm")).

name: whose random draws the object has: the name of the file, else "mesh". Meshes of one name
are scored under the same draws, as one before and after a change should be.

InputError for other shapes, indices out of range, numbers that are not finite and files that are
no mesh. What is no solid may be made and looked at; what needs one repairs it and refuses it.)")
      .def(py::init(&MakeMesh), py::arg("vertices"), py::arg("faces") = py::none(), py::kw_only(),
           py::arg("name") = py::none())
      .def_property_readonly("name", &MeshObject::name)
      .def_property_readonly("vertices", &Vertices, "array (V, 3), read-only, no copy")
      .def_property_readonly("faces", &Faces, "array (F, 3) of int32, read-only, no copy")
      .def_property_readonly(
          "notes", [](const MeshObject& self) { return self.file().notes; },
          "what the file's reader left out or read otherwise")
      .def_property_readonly("bounds", &BoundsArray, "array (2, 3): least and largest corner")
      .def_property_readonly(
          "volume", [](const MeshObject& self) { return Volume(self.mesh()); }, "signed")
      .def_property_readonly("area",
                             [](const MeshObject& self) { return SurfaceArea(self.mesh()); })
      .def_property_readonly(
          "center_of_mass",
          [](const MeshObject& self) { return ArrayOf(CenterOfMass(self.mesh())); }, "array (3,)")
      .def(
          "inspect", [](const MeshObject& self) { return Inspect(self.mesh()); }, Released(),
          "What the mesh is as it is, before any repair: an Inspection.")
      .def_property_readonly(
          "status",
          [](const MeshObject& self) {
            const py::gil_scoped_release released;
            return self.Usable()->status;
          },
          "'ok', or what keeps it from being a solid even after repair")
      .def(
          "repaired",
          [](const MeshObject& self) {
            return std::make_shared<MeshObject>(*self.RequireUsable());
          },
          Released(), "The solid that everything else works on. InputError when there is none.")
      .def("sdf", &GridOfMesh, Released(), py::arg("n") = 32,
           "Exact signed distances on n^3 nodes about the mesh, 16 <= n <= 256: a Grid.\n"
           "InputError when the mesh is no solid.")
      .def(
          "remesh", [](const MeshObject& self, int n) { return MeshOfGrid(GridOfMesh(self, n)); },
          Released(), py::arg("n") = 32,
          "The mesh of sdf(n), in the place of this one: what a grid of that size keeps of it.\n"
          "InputError when that is no solid, as of walls thinner than the grid's cells.")
      .def("stable_poses", &StablePosesOfMesh, Released(),
           "StablePoses on a table after a drop in a random orientation; none of a flat thing.")
      .def(
          "save",
          [](const MeshObject& self, const std::filesystem::path& path, double scale) {
            WriteMesh(path, self.mesh(), scale);
          },
          Released(), py::arg("path"), py::arg("scale") = 1.0,
          "Writes STL, OBJ, PLY or OFF by extension, coordinates times scale.")
      .def("__repr__", &MeshRepr);
}

}  // namespace antigrasp::python
