#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "antigrasp/mesh/length_unit.h"
#include "antigrasp/mesh/triangle_mesh.h"

namespace antigrasp {

// A mesh in the coordinates of its file.
struct MeshFile {
  TriangleMesh mesh;
  std::optional<FileUnit> unit;    // what they are in, of 3MF, GLB and COLLADA, which say so
  std::vector<std::string> notes;  // what was left out or read otherwise, a few words each
};

// Reads STL (ascii or binary), OBJ, PLY, OFF, 3MF, GLB or COLLADA by content and extension.
// Polygons are triangulated, several groups joined, exactly equal positions merged; nothing else is
// repaired (see repair.h). Of 3MF what is built, of GLB the default scene, every object at its
// place; the axes stay (glTF's y is up). InputError when the file is missing, a directory,
// truncated, of another format or not finite.
MeshFile ReadMeshFile(const std::filesystem::path& path);

// The mesh in `unit` when its file knows its own, else as it is.
TriangleMesh InUnit(MeshFile file, LengthUnit unit);

// The mesh alone, in the coordinates of its file. `notes`: those of the file.
TriangleMesh ReadMesh(const std::filesystem::path& path, std::vector<std::string>* notes = nullptr);

// Whether ReadMesh knows the extension (case does not matter).
bool IsMeshFile(const std::filesystem::path& path);

// The mesh file of this name without extension, in whatever format: STL before OBJ, PLY and OFF. A
// path with .stl when there is none.
std::filesystem::path FindMeshFile(const std::filesystem::path& folder, const std::string& name);

// Writes STL (binary), OBJ, PLY (binary) or OFF by extension, atomically. STL has no unit: `scale`
// multiplies the coordinates (1000 turns metres to the millimetres that slicers assume).
void WriteMesh(const std::filesystem::path& path, const TriangleMesh& mesh, double scale = 1.0);

}  // namespace antigrasp
