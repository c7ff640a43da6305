#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "antigrasp/core/choice.h"

namespace antigrasp {

enum class MeshFormat { kStl, kObj, kPly, kOff, k3mf, kGlb, kDae };
constexpr auto ChoicesOf(MeshFormat) {  // extensions
  return std::to_array<Choice<MeshFormat>>({{MeshFormat::kStl, "stl"},
                                            {MeshFormat::kObj, "obj"},
                                            {MeshFormat::kPly, "ply"},
                                            {MeshFormat::kOff, "off"},
                                            {MeshFormat::k3mf, "3mf"},
                                            {MeshFormat::kGlb, "glb"},
                                            {MeshFormat::kDae, "dae"}});
}

// What ReadMesh and WriteMesh know; every help text, check and message is made from these lists.
inline constexpr std::array kReadableFormats = {
    MeshFormat::kStl, MeshFormat::kObj, MeshFormat::kPly, MeshFormat::kOff,
    MeshFormat::k3mf, MeshFormat::kGlb, MeshFormat::kDae};
inline constexpr std::array kWritableFormats = {MeshFormat::kStl, MeshFormat::kObj,
                                                MeshFormat::kPly, MeshFormat::kOff};

std::vector<std::string> ReadableExtensions();  // "stl", "obj", ...
std::vector<std::string> WritableExtensions();

// By extension, case does not matter; nullopt when it is of no readable format.
std::optional<MeshFormat> FindReadableFormat(const std::filesystem::path& path);
// InputError when the extension is of no such format.
MeshFormat RequireReadableFormat(const std::filesystem::path& path);
MeshFormat RequireWritableFormat(const std::filesystem::path& path);

}  // namespace antigrasp
