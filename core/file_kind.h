#pragma once

#include <filesystem>

namespace antigrasp {

// What a readable file is by its first bytes, whether it is whole or not.
bool IsHdf5(const std::filesystem::path& path);
bool IsZip(const std::filesystem::path& path);  // as LibTorch's archives are

}  // namespace antigrasp
