#pragma once

#include <filesystem>
#include <string>

namespace antigrasp {

// What a readable file is by its first bytes, whether it is whole or not.
bool IsHdf5(const std::filesystem::path& path);
bool IsZip(const std::filesystem::path& path);  // as LibTorch's archives are

enum class FileKind { kUnknown, kHdf5, kZip, kPng, kTable, kMesh };
// The same for every kind: of text the first 4 KB are looked at. A table is one with names of two
// columns or more in its first line; a mesh is STL, PLY, OFF, OBJ or GLB
// (3MF is a zip archive).
FileKind KindOf(const std::filesystem::path& path);

// InputError "is a table of object, status, ..., not a mesh" for a file that is known to be of
// another kind than the one wanted, which `noun` names; `expected` ends the line.
void RefuseOtherKind(const std::filesystem::path& path, FileKind wanted, const std::string& noun,
                     const std::string& expected);

}  // namespace antigrasp
