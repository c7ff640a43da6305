#pragma once

#include <filesystem>
#include <vector>

#include "antigrasp/core/parallel.h"
#include "antigrasp/datasets/import.h"
#include "antigrasp/datasets/shape_set.h"

namespace antigrasp {

// The files of grids among the inputs (SDF files, .npy, .npz, .vti), and those of these extensions
// in a folder in which there is no mesh; empty when there is none. InputError for meshes beside
// them and for a missing path.
std::vector<std::filesystem::path> GridFilesOf(const std::vector<std::filesystem::path>& inputs);

// Their grids in one file, in whatever format its name says: distances of the unit cube, positive
// inside. A grid with values that are no numbers and one whose border is inside are refused, the
// report of every other says whether it is a solid. Of one file kind, seed and truncation stay.
// InputError for files of different resolution or truncation, and when no grid is usable. Grid by
// grid: memory does not grow with their number.
std::vector<ImportedMesh> ImportGrids(const std::vector<std::filesystem::path>& files,
                                      const std::filesystem::path& out, const GridMeaning& meaning,
                                      int threads, const ProgressFn& progress = nullptr);

}  // namespace antigrasp
