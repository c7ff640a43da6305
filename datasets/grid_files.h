#pragma once

#include <functional>
#include <memory>
#include <span>

#include "antigrasp/datasets/shape_set.h"

// What every format of shape_format.h is to shape_set.cpp. Only for .cpp files of this folder.
namespace antigrasp {

inline constexpr std::uint64_t kMostNodes = 512;  // along one side
inline constexpr std::uint64_t kMostGrids = 10'000'000;

// A file that is read; grids by any thread.
class GridSource {
 public:
  virtual ~GridSource() = default;
  virtual const ShapeSetInfo& info() const = 0;
  virtual std::vector<std::string> Names() const = 0;
  virtual SdfGrid Grid(int i) const = 0;
};
std::unique_ptr<GridSource> OpenHdf5Grids(const std::filesystem::path& path);

// A file that is written, there as a whole after Commit().
class GridSink {
 public:
  virtual ~GridSink() = default;
  // `about` without names and grids, what all `count` grids share without its values.
  virtual void Begin(const ShapeSet& about, std::size_t count, const SdfGrid& first) = 0;
  virtual void Add(const std::vector<float>& values) = 0;
  virtual void Commit(const std::vector<std::string>& names) = 0;
};
// InputError for a path that cannot be written.
std::unique_ptr<GridSink> MakeHdf5Sink(const std::filesystem::path& path);
std::unique_ptr<GridSink> MakeNpySink(const std::filesystem::path& path);
std::unique_ptr<GridSink> MakeNpzSink(const std::filesystem::path& path);
std::unique_ptr<GridSink> MakeVtiSink(const std::filesystem::path& path);

// What another format holds, before anybody says what it means.
struct ForeignGrids {
  ShapeSetInfo info;   // count and n; the rest where the file says it
  bool says = false;   // a file of ours: sign and unit of its values are known
  double spacing = 0;  // of the nodes, where the file says it
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  // of a file of ours
  std::vector<std::string> names;
  std::function<void(int, std::span<float>)> read;  // any thread
};
ForeignGrids ReadNpyGrids(const std::filesystem::path& path);
ForeignGrids ReadNpzGrids(const std::filesystem::path& path);
ForeignGrids ReadVtiGrids(const std::filesystem::path& path);

// Such grids as those of the unit cube, positive inside. InputError where the file contradicts
// `meaning` or most of its first grids do (grid_check.h).
std::unique_ptr<GridSource> MeantGrids(ForeignGrids grids, const GridMeaning& meaning,
                                       const std::filesystem::path& path);

// InputError when anything is meant of a file that says it itself.
void RequireNothingMeant(const GridMeaning& meaning, const std::string& path);

// InputError unless there are 1 to kMostNodes nodes along each side and at most kMostGrids grids.
void RequireUsableSize(std::uint64_t count, std::uint64_t n, const std::string& where);

}  // namespace antigrasp
