#pragma once

#include "antigrasp/datasets/grid_files.h"
#include "antigrasp/datasets/npy_header.h"

namespace antigrasp {

// How the grids of an array lie: [N, n, n, n], [N, 1, n, n, n] or one grid [n, n, n].
struct NpyGrids {
  std::uint64_t count = 0, n = 0;
  std::size_t float_size = 0, begin = 0;  // bytes of a value, and before the first
  std::uint64_t bytes() const { return begin + count * n * n * n * float_size; }  // of the file
};

// InputError for an array of another shape or type.
NpyGrids NpyGridsOf(const NpyHeader& header, const std::string& where);

// What grids are called that have no names: after their file, numbered where there are several.
std::vector<std::string> NamesAfterFile(const std::filesystem::path& path, std::uint64_t count);

}  // namespace antigrasp
