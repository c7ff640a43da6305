#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "antigrasp/sdf/sdf_grid.h"

namespace antigrasp {

// Signed-distance grids of one kind and where they came from.
struct ShapeSet {
  std::string kind;  // "cylinders", "prisms", "bottles", "import", "samples", "elites"
  std::uint64_t seed = 0;
  std::string provenance;          // one line: command, checkpoint, version
  double truncation = 0.0;         // 0: exact distances; tau: values clamped to [-tau, tau]
  std::vector<std::string> names;  // one per grid ("cylinders-000017", "mug.stl")
  std::vector<SdfGrid> grids;      // all of one n, spacing, origin
};

// HDF5 layout in docs/formats.md: dataset /sdf float32 [N, n, n, n] (z, y, x; chunked, shuffled,
// deflated), /names, attributes format = "antigrasp.sdf", version, kind, seed, spacing, origin,
// sign = "positive inside", unit, truncation, provenance. Written atomically.
void WriteShapeSet(const std::filesystem::path& path, const ShapeSet& set);

// InputError naming the path for a missing, foreign, truncated or inconsistent file.
ShapeSet ReadShapeSet(const std::filesystem::path& path);

struct ShapeSetInfo {
  std::string kind, provenance;
  std::uint64_t seed = 0;
  int count = 0, n = 0, version = 0;
  double spacing = 0.0, truncation = 0.0;
};
ShapeSetInfo ReadShapeSetInfo(const std::filesystem::path& path);  // attributes only, no grids
std::vector<std::string> ReadShapeNames(const std::filesystem::path& path);  // names, no grids
bool IsShapeSet(const std::filesystem::path& path);  // by content, never throws

}  // namespace antigrasp
