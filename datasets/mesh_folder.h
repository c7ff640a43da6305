#pragma once

#include <filesystem>
#include <vector>

namespace antigrasp {

// The mesh files in a folder and the folders in it, sorted by path. Folders that may not be read
// are passed over; InputError when the folder itself cannot be searched.
std::vector<std::filesystem::path> MeshFilesIn(const std::filesystem::path& folder);

// The same for files of grids that other programs write: .npy, .npz, .vti.
std::vector<std::filesystem::path> GridFilesIn(const std::filesystem::path& folder);

}  // namespace antigrasp
