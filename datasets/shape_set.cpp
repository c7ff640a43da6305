#include "antigrasp/datasets/shape_set.h"

#include <cmath>
#include <cstdio>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/check.h"
#include "antigrasp/core/error.h"
#include "antigrasp/core/file_kind.h"
#include "antigrasp/datasets/hdf5_damage.h"
#include "antigrasp/datasets/hdf5_file.h"
#include "antigrasp/mesh/mesh_file.h"

namespace antigrasp {
namespace {

constexpr std::uint64_t kVersion = 2;
constexpr std::uint64_t kMostNodes = 512;  // along one side
constexpr std::uint64_t kMostGrids = 10'000'000;
constexpr const char* kFormat = "antigrasp.sdf";
constexpr const char* kWholeFile =
    "an antigrasp SDF file (HDF5 with attribute format = \"antigrasp.sdf\")";

// Every way in which a file can be wrong, as one InputError.
class Reader {
 public:
  explicit Reader(const std::filesystem::path& path) : path_(path) {
    RequireFile(path, kWholeFile);
    file_ = Hdf5File::Open(path);
    if (!file_) {
      RefuseOtherKind(path, FileKind::kHdf5, "an SDF file", kWholeFile);
      Fail(IsTruncatedHdf5(path) ? "truncated HDF5 file"
           : IsHdf5(path)        ? "damaged HDF5 file"
                                 : "not an HDF5 file",
           kWholeFile);
    }
    const auto format = file_->StringAttribute("format");
    if (!format) Fail("no attribute format", kWholeFile);
    if (*format != kFormat) Fail("format = \"" + *format + "\"", kWholeFile);
    const std::uint64_t version = Number("version");
    if (version < 1 || version > kVersion) {
      Fail("version = " + std::to_string(version), "version 1 to " + std::to_string(kVersion));
    }
  }

  ShapeSetInfo Info() const {
    ShapeSetInfo info;
    info.version = static_cast<int>(Number("version"));
    info.kind = Text("kind");
    info.provenance = Text("provenance");
    info.seed = Number("seed");
    info.spacing = Real("spacing");
    info.truncation = Real("truncation");
    if (!(std::isfinite(info.spacing) && info.spacing > 0.0)) {
      Fail("spacing is not a length", "attribute spacing > 0");
    }
    if (!(std::isfinite(info.truncation) && info.truncation >= 0.0)) {
      Fail("truncation is not a length", "attribute truncation >= 0");
    }
    // Version 1 had all attributes on the root group.
    const std::string sign = Text("sign", info.version == 1 ? "/" : "/sdf");
    if (sign != "positive inside") {
      Fail("sign = \"" + sign + "\"", "sign = \"positive inside\"");
    }
    info.side = file_->DoubleAttribute("side", "/sdf").value_or(0.0);
    if (!(std::isfinite(info.side) && info.side >= 0.0)) {
      Fail("side is not a length", "attribute side of /sdf >= 0");
    }
    const std::vector<std::uint64_t> extents = file_->Extents("/sdf");
    const bool cubes = extents.size() == 4 && extents[1] == extents[2] && extents[2] == extents[3];
    if (!cubes || extents[1] < 1 || extents[1] > kMostNodes || !file_->HoldsFloats("/sdf")) {
      Fail("no usable dataset /sdf",
           "dataset /sdf of float and shape [N, n, n, n], n in 1 to " + std::to_string(kMostNodes));
    }
    // Deflate shrinks at most 1032-fold: what claims more than that was never written.
    const std::uint64_t grid_bytes = extents[1] * extents[1] * extents[1] * sizeof(float);
    if (extents[0] > kMostGrids ||
        extents[0] > 1100 * file_->StoredBytes("/sdf") / grid_bytes + 1 ||
        (extents[0] > 0 && file_->StoredBytes("/sdf") == 0)) {
      Fail("dataset /sdf is incomplete", "every grid written");
    }
    info.count = static_cast<int>(extents[0]);
    info.n = static_cast<int>(extents[1]);
    return info;
  }

  Eigen::Vector3d Origin() const {
    const auto origin = file_->DoublesAttribute("origin");
    const Eigen::Vector3d value = origin && origin->size() == 3 ? Eigen::Vector3d(origin->data())
                                                                : Eigen::Vector3d(NAN, 0, 0);
    if (!value.allFinite()) Fail("no usable attribute origin", "attribute origin, 3 numbers");
    return value;
  }

  std::vector<std::string> Names(int count) const {
    const std::vector<std::uint64_t> extents = file_->Extents("/names");
    if (extents == std::vector<std::uint64_t>{static_cast<std::uint64_t>(count)}) {
      if (auto names = file_->ReadStrings("/names")) return *std::move(names);
    }
    Fail("no usable dataset /names", "dataset /names of " + std::to_string(count) + " strings");
  }

  SdfGrid Grid(int i, const ShapeSetInfo& info, const Eigen::Vector3d& origin) const {
    const auto n = static_cast<std::size_t>(info.n);
    SdfGrid grid{info.n, info.spacing, origin, std::vector<float>(n * n * n)};
    if (!file_->ReadFloats("/sdf", static_cast<std::uint64_t>(i), grid.values.data())) {
      Fail("grid " + std::to_string(i) + " of /sdf cannot be read", "an undamaged file");
    }
    return grid;
  }

 private:
  [[noreturn]] void Fail(const std::string& what, const std::string& expected) const {
    throw InputError(what, path_.string(), expected);
  }
  std::uint64_t Number(const std::string& name) const {
    if (const auto value = file_->UintAttribute(name)) return *value;
    Fail("no usable attribute " + name, "attribute " + name + ", a whole number");
  }
  double Real(const std::string& name) const {
    if (const auto value = file_->DoubleAttribute(name)) return *value;
    Fail("no usable attribute " + name, "attribute " + name + ", a number");
  }
  std::string Text(const std::string& name, const std::string& object = "/") const {
    if (auto value = file_->StringAttribute(name, object)) return *std::move(value);
    const std::string where = object == "/" ? "" : " of " + object;
    Fail("no usable attribute " + name + where, "attribute " + name + where + ", a string");
  }

  std::filesystem::path path_;
  std::unique_ptr<Hdf5File> file_;
};

}  // namespace

struct ShapeSetWriter::Impl {
  Impl(const std::filesystem::path& path, ShapeSet set, std::size_t grids)
      : target(path), about(std::move(set)), count(grids) {}

  AtomicFile target;
  ShapeSet about;  // its names grow
  std::size_t count;
  SdfGrid first{};  // without its values
  std::unique_ptr<Hdf5File> file;

  // What all grids share.
  void Begin(const SdfGrid& grid) {
    first = {grid.n, grid.spacing, grid.origin, {}};
    const auto n = static_cast<std::uint64_t>(grid.n);
    file = Hdf5File::Create(target.temp_path());
    file->WriteAttribute("format", std::string(kFormat));
    file->WriteAttribute("version", kVersion);
    file->WriteAttribute("kind", about.kind);
    file->WriteAttribute("seed", about.seed);
    file->WriteAttribute("spacing", grid.spacing);
    file->WriteAttribute("origin",
                         std::vector<double>{grid.origin.x(), grid.origin.y(), grid.origin.z()});
    file->WriteAttribute("truncation", about.truncation);
    file->WriteAttribute("provenance", about.provenance);
    file->CreateFloats("/sdf", count, {n, n, n});
    file->WriteAttribute("sign", std::string("positive inside"), "/sdf");
    file->WriteAttribute("unit", std::string("side of the unit cube"), "/sdf");
    if (about.side > 0.0) file->WriteAttribute("side", about.side, "/sdf");
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
  impl_->file->AppendFloats(grid.values.data());
  names.push_back(std::move(name));
}

void ShapeSetWriter::Commit() {
  AG_CHECK(impl_->about.names.size() == impl_->count, "as many grids as were announced");
  if (impl_->count == 0) impl_->Begin(SdfGrid{});
  impl_->file->WriteStrings("/names", impl_->about.names);
  impl_->file->Close();
  impl_->target.Commit();
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
  explicit Impl(const std::filesystem::path& path) : file(path) {}
  Reader file;
  ShapeSetInfo info = file.Info();
  Eigen::Vector3d origin = file.Origin();
};

ShapeSetReader::ShapeSetReader(const std::filesystem::path& path)
    : impl_(std::make_unique<Impl>(path)) {}
ShapeSetReader::~ShapeSetReader() = default;

const ShapeSetInfo& ShapeSetReader::info() const { return impl_->info; }
std::vector<std::string> ShapeSetReader::Names() const {
  return impl_->file.Names(impl_->info.count);
}
SdfGrid ShapeSetReader::Grid(int i) const {
  return impl_->file.Grid(i, impl_->info, impl_->origin);
}

ShapeSet ReadShapeSet(const std::filesystem::path& path) {
  const ShapeSetReader reader(path);
  const ShapeSetInfo& info = reader.info();
  ShapeSet set{info.kind,      info.seed, info.provenance, info.truncation,
               reader.Names(), {},        info.side};
  for (int i = 0; i < info.count; ++i) set.grids.push_back(reader.Grid(i));
  return set;
}

ShapeSetInfo ReadShapeSetInfo(const std::filesystem::path& path) { return Reader(path).Info(); }

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
  const Reader reader(path);
  return reader.Names(reader.Info().count);
}

bool IsShapeSet(const std::filesystem::path& path) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return false;
  const auto file = Hdf5File::Open(path);
  return file && file->StringAttribute("format") == kFormat;
}

}  // namespace antigrasp
