#include "antigrasp/datasets/shape_set.h"

#include <cmath>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/check.h"
#include "antigrasp/core/error.h"
#include "antigrasp/datasets/hdf5_file.h"

namespace antigrasp {
namespace {

constexpr std::uint64_t kVersion = 1;
constexpr std::uint64_t kMostNodes = 512;  // along one side
constexpr std::uint64_t kMostGrids = 10'000'000;
constexpr const char* kFormat = "antigrasp.sdf";
constexpr const char* kWholeFile =
    "an antigrasp SDF file (HDF5 with attribute format = \"antigrasp.sdf\")";

void CheckConsistent(const ShapeSet& set) {
  AG_CHECK(set.names.size() == set.grids.size(), "a shape set needs one name for each grid");
  if (set.grids.empty()) return;
  const SdfGrid& first = set.grids.front();
  const auto n = static_cast<std::size_t>(first.n);
  for (const SdfGrid& grid : set.grids) {
    AG_CHECK(grid.n == first.n && grid.spacing == first.spacing && grid.origin == first.origin,
             "the grids of a shape set have one size and place");
    AG_CHECK(grid.values.size() == n * n * n, "grid size");
  }
}

// Every way in which a file can be wrong, as one InputError.
class Reader {
 public:
  explicit Reader(const std::filesystem::path& path) : path_(path) {
    RequireFile(path, kWholeFile);
    file_ = Hdf5File::Open(path);
    if (!file_) Fail("not an HDF5 file, or a damaged or truncated one", kWholeFile);
    const auto format = file_->StringAttribute("format");
    if (!format) Fail("no attribute format", kWholeFile);
    if (*format != kFormat) Fail("format = \"" + *format + "\"", kWholeFile);
    const std::uint64_t version = Number("version");
    if (version != kVersion) {
      Fail("version = " + std::to_string(version), "version " + std::to_string(kVersion));
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
    if (const std::string sign = Text("sign"); sign != "positive inside") {
      Fail("sign = \"" + sign + "\"", "sign = \"positive inside\"");
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

  std::vector<SdfGrid> Grids(const ShapeSetInfo& info, const Eigen::Vector3d& origin) const {
    const auto n = static_cast<std::size_t>(info.n);
    std::vector<SdfGrid> grids;
    for (int i = 0; i < info.count; ++i) {
      SdfGrid grid{info.n, info.spacing, origin, std::vector<float>(n * n * n)};
      if (!file_->ReadFloats("/sdf", static_cast<std::uint64_t>(i), grid.values.data())) {
        Fail("grid " + std::to_string(i) + " of /sdf cannot be read", "an undamaged file");
      }
      grids.push_back(std::move(grid));
    }
    return grids;
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
  std::string Text(const std::string& name) const {
    if (auto value = file_->StringAttribute(name)) return *std::move(value);
    Fail("no usable attribute " + name, "attribute " + name + ", a string");
  }

  std::filesystem::path path_;
  std::unique_ptr<Hdf5File> file_;
};

}  // namespace

void WriteShapeSet(const std::filesystem::path& path, const ShapeSet& set) {
  CheckConsistent(set);
  const SdfGrid grid = set.grids.empty() ? SdfGrid{} : set.grids.front();
  const auto n = static_cast<std::uint64_t>(grid.n);
  std::vector<const float*> values;
  for (const SdfGrid& g : set.grids) values.push_back(g.values.data());
  const auto file = Hdf5File::Create();
  file->WriteAttribute("format", std::string(kFormat));
  file->WriteAttribute("version", kVersion);
  file->WriteAttribute("kind", set.kind);
  file->WriteAttribute("seed", set.seed);
  file->WriteAttribute("spacing", grid.spacing);
  file->WriteAttribute("origin",
                       std::vector<double>{grid.origin.x(), grid.origin.y(), grid.origin.z()});
  file->WriteAttribute("sign", std::string("positive inside"));
  file->WriteAttribute("unit", std::string("side of the unit cube"));
  file->WriteAttribute("truncation", set.truncation);
  file->WriteAttribute("provenance", set.provenance);
  file->WriteFloats("/sdf", values, {n, n, n});
  file->WriteStrings("/names", set.names);
  WriteFileAtomic(path, file->Bytes());
}

ShapeSet ReadShapeSet(const std::filesystem::path& path) {
  const Reader reader(path);
  const ShapeSetInfo info = reader.Info();
  ShapeSet set;
  set.kind = info.kind;
  set.seed = info.seed;
  set.provenance = info.provenance;
  set.truncation = info.truncation;
  set.names = reader.Names(info.count);
  set.grids = reader.Grids(info, reader.Origin());
  return set;
}

ShapeSetInfo ReadShapeSetInfo(const std::filesystem::path& path) { return Reader(path).Info(); }

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
