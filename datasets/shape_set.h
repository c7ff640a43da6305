#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "antigrasp/core/choice.h"
#include "antigrasp/datasets/shape_format.h"
#include "antigrasp/sdf/sdf_grid.h"

namespace antigrasp {

// Signed-distance grids of one kind and where they came from.
struct ShapeSet {
  std::string kind;  // "cylinders", "prisms", "bottles", "import", "samples", "elites"
  std::uint64_t seed = 0;
  std::string provenance = {};          // one line: command, checkpoint, version
  double truncation = 0.0;              // 0: exact distances; tau: values clamped to [-tau, tau]
  std::vector<std::string> names = {};  // one per grid ("cylinders-000017", "mug.stl")
  std::vector<SdfGrid> grids = {};      // all of one n, spacing, origin
  double side = 0.0;  // of the unit cube, in the unit of the meshes it came from; 0: no one length
};

// InputError for a name that says mesh ("mug.obj"): an SDF file under it would take a mesh's place.
void RequireShapeSetName(const std::filesystem::path& path);

// HDF5 layout in docs/formats.md: dataset /sdf float32 [N, n, n, n] (z, y, x; chunked, shuffled,
// deflated) with its attributes sign = "positive inside", unit and side, /names, attributes format
// = "antigrasp.sdf", version, kind, seed, spacing, origin, truncation, provenance; .npz and .vti
// hold the same, .npy the grids alone. Written grid by grid, so that memory does not grow with the
// set; there when Commit() returns, else nothing is.
class ShapeSetWriter {
 public:
  // `about`: everything but its names and grids, of which `count` will follow. InputError for a
  // path that cannot be written and by RequireShapeSetName.
  ShapeSetWriter(const std::filesystem::path& path, ShapeSet about, std::size_t count);
  ~ShapeSetWriter();
  // Throws RuntimeFailure when the disk is full. One thread at a time.
  void Add(std::string name, const SdfGrid& grid);
  void Commit();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};
void WriteShapeSet(const std::filesystem::path& path, const ShapeSet& set);

// What the values of a file mean that does not say it: arrays of other programs. Of the file: as it
// says, else positive inside.
enum class GridSign { kOfFile, kPositiveInside, kNegativeInside };
constexpr auto ChoicesOf(GridSign) {
  return std::to_array<Choice<GridSign>>({{GridSign::kOfFile, "of-file"},
                                          {GridSign::kPositiveInside, "positive-inside"},
                                          {GridSign::kNegativeInside, "negative-inside"}});
}
struct GridMeaning {
  GridSign sign = GridSign::kOfFile;
  double spacing = 0.0;  // of the nodes in the unit of the values; 0: the file's, else 1/n
};

struct ShapeSetInfo {
  ShapeFormat format = ShapeFormat::kHdf5;
  std::string kind, provenance;
  std::uint64_t seed = 0;
  int count = 0, n = 0, version = 0;
  double spacing = 0.0, truncation = 0.0, side = 0.0;
};

// An SDF file, or an array of other programs (shape_format.h), whose grids are read when they are
// asked for, by any thread. Distances of others become those of the unit cube, positive inside;
// info().side is the cube's side in their unit. Everything throws InputError naming the path: for a
// missing, foreign, truncated or inconsistent file the constructor, so for one whose sign or
// spacing is not what it says (grid_check.h); for a damaged grid Grid(). Arrays that are packed
// wait unpacked in the folder for temporary files.
class ShapeSetReader {
 public:
  explicit ShapeSetReader(const std::filesystem::path& path, const GridMeaning& meaning = {});
  ~ShapeSetReader();
  const ShapeSetInfo& info() const;
  std::vector<std::string> Names() const;  // one per grid
  SdfGrid Grid(int i) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};
ShapeSet ReadShapeSet(const std::filesystem::path& path);

ShapeSetInfo ReadShapeSetInfo(const std::filesystem::path& path);  // attributes only, no grids
// "antigrasp SDF file, version 2" or another kind of file; then what follows here.
std::string ShapeFileText(const ShapeSetInfo& info);
// The same for people, a line each with two spaces before it.
std::string ShapeSetText(const ShapeSetInfo& info);
std::vector<std::string> ReadShapeNames(const std::filesystem::path& path);  // names, no grids
bool IsShapeSet(const std::filesystem::path& path);  // by content, never throws

}  // namespace antigrasp
