#include "antigrasp/datasets/shape_set.h"

#include <cstdio>
#include <utility>

#include "antigrasp/core/check.h"
#include "antigrasp/core/error.h"
#include "antigrasp/datasets/grid_files.h"
#include "antigrasp/datasets/hdf5_file.h"
#include "antigrasp/mesh/mesh_file.h"

namespace antigrasp {
namespace {

std::unique_ptr<GridSink> SinkFor(const std::filesystem::path& path) {
  switch (ShapeFormatByName(path)) {
    case ShapeFormat::kHdf5:
      return MakeHdf5Sink(path);
    case ShapeFormat::kNpy:
      return MakeNpySink(path);
    case ShapeFormat::kNpz:
      return MakeNpzSink(path);
    case ShapeFormat::kVti:
      return MakeVtiSink(path);
  }
  AG_CHECK(false, "unknown format of grids");
}

std::unique_ptr<GridSource> OpenGrids(const std::filesystem::path& path,
                                      const GridMeaning& meaning) {
  switch (ShapeFormatOf(path)) {
    case ShapeFormat::kHdf5: {
      auto grids = OpenHdf5Grids(path);
      RequireNothingMeant(meaning, path.string());
      return grids;
    }
    case ShapeFormat::kNpy:
      return MeantGrids(ReadNpyGrids(path), meaning, path);
    case ShapeFormat::kNpz:
      return MeantGrids(ReadNpzGrids(path), meaning, path);
    case ShapeFormat::kVti:
      return MeantGrids(ReadVtiGrids(path), meaning, path);
  }
  AG_CHECK(false, "unknown format of grids");
}

std::string KindOfFile(const ShapeSetInfo& info) {
  switch (info.format) {
    case ShapeFormat::kHdf5:
      return "antigrasp SDF file, version " + std::to_string(info.version);
    case ShapeFormat::kNpy:
      return "SDF grids as NumPy's array (.npy)";
    case ShapeFormat::kNpz:
      return "SDF grids as NumPy's archive (.npz)";
    case ShapeFormat::kVti:
      return "SDF grids as VTK's image data (.vti)";
  }
  AG_CHECK(false, "unknown format of grids");
}

}  // namespace

struct ShapeSetWriter::Impl {
  Impl(const std::filesystem::path& path, ShapeSet set, std::size_t grids)
      : sink(SinkFor(path)), about(std::move(set)), count(grids) {}

  std::unique_ptr<GridSink> sink;
  ShapeSet about;  // its names grow
  std::size_t count;
  SdfGrid first{};  // without its values

  // What all grids share.
  void Begin(const SdfGrid& grid) {
    first = {grid.n, grid.spacing, grid.origin, {}};
    sink->Begin(about, count, first);
  }
};

void RequireShapeSetName(const std::filesystem::path& path) {
  if (!IsMeshFile(path)) return;
  throw InputError("the name of a mesh", path.string(), "one for an SDF file, as NAME.h5");
}

ShapeSetWriter::ShapeSetWriter(const std::filesystem::path& path, ShapeSet about, std::size_t count)
    : impl_(std::make_unique<Impl>(path, std::move(about), count)) {
  RequireShapeSetName(path);
  impl_->about.names.clear();
  impl_->about.grids.clear();
}

ShapeSetWriter::~ShapeSetWriter() = default;

void ShapeSetWriter::Add(std::string name, const SdfGrid& grid) {
  std::vector<std::string>& names = impl_->about.names;
  AG_CHECK(names.size() < impl_->count, "no more grids than were announced");
  if (names.empty()) impl_->Begin(grid);
  const SdfGrid& first = impl_->first;
  const auto n = static_cast<std::size_t>(first.n);
  AG_CHECK(grid.n == first.n && grid.spacing == first.spacing && grid.origin == first.origin,
           "the grids of a shape set have one size and place");
  AG_CHECK(grid.values.size() == n * n * n, "grid size");
  impl_->sink->Add(grid.values);
  names.push_back(std::move(name));
}

void ShapeSetWriter::Commit() {
  AG_CHECK(impl_->about.names.size() == impl_->count, "as many grids as were announced");
  if (impl_->count == 0) impl_->Begin(SdfGrid{});
  impl_->sink->Commit(impl_->about.names);
}

void WriteShapeSet(const std::filesystem::path& path, const ShapeSet& set) {
  AG_CHECK(set.names.size() == set.grids.size(), "a shape set needs one name for each grid");
  ShapeSetWriter writer(path,
                        {set.kind, set.seed, set.provenance, set.truncation, {}, {}, set.side},
                        set.grids.size());
  for (std::size_t i = 0; i < set.grids.size(); ++i) writer.Add(set.names[i], set.grids[i]);
  writer.Commit();
}

struct ShapeSetReader::Impl {
  std::unique_ptr<GridSource> grids;
};

ShapeSetReader::ShapeSetReader(const std::filesystem::path& path, const GridMeaning& meaning)
    : impl_(std::make_unique<Impl>(OpenGrids(path, meaning))) {}
ShapeSetReader::~ShapeSetReader() = default;

const ShapeSetInfo& ShapeSetReader::info() const { return impl_->grids->info(); }
std::vector<std::string> ShapeSetReader::Names() const { return impl_->grids->Names(); }
SdfGrid ShapeSetReader::Grid(int i) const { return impl_->grids->Grid(i); }

ShapeSet ReadShapeSet(const std::filesystem::path& path) {
  const ShapeSetReader reader(path);
  const ShapeSetInfo& info = reader.info();
  ShapeSet set{info.kind,      info.seed, info.provenance, info.truncation,
               reader.Names(), {},        info.side};
  for (int i = 0; i < info.count; ++i) set.grids.push_back(reader.Grid(i));
  return set;
}

ShapeSetInfo ReadShapeSetInfo(const std::filesystem::path& path) {
  return ShapeSetReader(path).info();
}

std::string ShapeFileText(const ShapeSetInfo& info) {
  return KindOfFile(info) + "\n" + ShapeSetText(info);
}

std::string ShapeSetText(const ShapeSetInfo& info) {
  char grids[96], spacing[96], values[64] = "exact distances";
  std::snprintf(grids, sizeof grids, "%d of %d^3", info.count, info.n);
  std::snprintf(spacing, sizeof spacing, "%g (unit cube), positive inside", info.spacing);
  if (info.truncation > 0) {
    std::snprintf(values, sizeof values, "clamped to +-%g", info.truncation);
  }
  return "  kind        " + info.kind + "\n  shapes      " + grids + "\n  spacing     " + spacing +
         "\n  values      " + values + "\n  seed        " + std::to_string(info.seed) +
         "\n  provenance  " + info.provenance + "\n";
}

std::vector<std::string> ReadShapeNames(const std::filesystem::path& path) {
  return ShapeSetReader(path).Names();
}

bool IsShapeSet(const std::filesystem::path& path) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return false;
  if (ShapeFormatOf(path) != ShapeFormat::kHdf5) return true;
  const auto file = Hdf5File::Open(path);
  return file && file->StringAttribute("format") == "antigrasp.sdf";
}

}  // namespace antigrasp
