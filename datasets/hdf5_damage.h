#pragma once

#include <filesystem>

namespace antigrasp {

// Whether a file begins as HDF5 files do (core/file_kind.h) and ends before its own header says. A
// file cut inside that header counts.
bool IsTruncatedHdf5(const std::filesystem::path& path);

}  // namespace antigrasp
