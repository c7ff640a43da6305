#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "antigrasp/mesh/triangle_mesh.h"

namespace antigrasp {

// Reads STL (ascii or binary), OBJ, PLY or OFF by content and extension. Polygons are triangulated,
// several groups joined, exactly equal positions merged; nothing else is repaired (see repair.h).
// InputError when the file is missing, a directory, truncated, of another format or not finite.
// `notes`: what was left out or read otherwise than the file says, a few words each.
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
