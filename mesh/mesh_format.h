#pragma once

#include <filesystem>
#include <optional>

namespace antigrasp {

enum class MeshFormat { kStl, kObj, kPly, kOff };

// By extension, case does not matter.
std::optional<MeshFormat> FindMeshFormat(const std::filesystem::path& path);
// InputError when the extension is of no mesh format.
MeshFormat RequireMeshFormat(const std::filesystem::path& path);

}  // namespace antigrasp
