#include <cmath>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/error.h"
#include "antigrasp/core/file_kind.h"
#include "antigrasp/datasets/grid_files.h"
#include "antigrasp/datasets/hdf5_damage.h"
#include "antigrasp/datasets/hdf5_file.h"

// The SDF file proper: HDF5.
namespace antigrasp {
namespace {

constexpr std::uint64_t kVersion = 2;
constexpr const char* kFormat = "antigrasp.sdf";
constexpr const char* kWholeFile =
    "an antigrasp SDF file (HDF5 with attribute format = \"antigrasp.sdf\")";

// Every way in which a file can be wrong, as one InputError.
class Hdf5Reader : public GridSource {
 public:
  explicit Hdf5Reader(const std::filesystem::path& path) : path_(path) {
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
    info_ = Info();
    origin_ = Origin();
  }

  const ShapeSetInfo& info() const override { return info_; }

  std::vector<std::string> Names() const override {
    const std::vector<std::uint64_t> extents = file_->Extents("/names");
    if (extents == std::vector<std::uint64_t>{static_cast<std::uint64_t>(info_.count)}) {
      if (auto names = file_->ReadStrings("/names")) return *std::move(names);
    }
    Fail("no usable dataset /names",
         "dataset /names of " + std::to_string(info_.count) + " strings");
  }

  SdfGrid Grid(int i) const override {
    const auto n = static_cast<std::size_t>(info_.n);
    SdfGrid grid{info_.n, info_.spacing, origin_, std::vector<float>(n * n * n)};
    if (!file_->ReadFloats("/sdf", static_cast<std::uint64_t>(i), grid.values.data())) {
      Fail("grid " + std::to_string(i) + " of /sdf cannot be read", "an undamaged file");
    }
    return grid;
  }

 private:
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
  ShapeSetInfo info_;
  Eigen::Vector3d origin_;
};

class Hdf5Sink : public GridSink {
 public:
  explicit Hdf5Sink(const std::filesystem::path& path) : target_(path) {}

  void Begin(const ShapeSet& about, std::size_t count, const SdfGrid& grid) override {
    const auto n = static_cast<std::uint64_t>(grid.n);
    file_ = Hdf5File::Create(target_.temp_path());
    file_->WriteAttribute("format", std::string(kFormat));
    file_->WriteAttribute("version", kVersion);
    file_->WriteAttribute("kind", about.kind);
    file_->WriteAttribute("seed", about.seed);
    file_->WriteAttribute("spacing", grid.spacing);
    file_->WriteAttribute("origin",
                          std::vector<double>{grid.origin.x(), grid.origin.y(), grid.origin.z()});
    file_->WriteAttribute("truncation", about.truncation);
    file_->WriteAttribute("provenance", about.provenance);
    file_->CreateFloats("/sdf", count, {n, n, n});
    file_->WriteAttribute("sign", std::string("positive inside"), "/sdf");
    file_->WriteAttribute("unit", std::string("side of the unit cube"), "/sdf");
    if (about.side > 0.0) file_->WriteAttribute("side", about.side, "/sdf");
  }
  void Add(const std::vector<float>& values) override { file_->AppendFloats(values.data()); }
  void Commit(const std::vector<std::string>& names) override {
    file_->WriteStrings("/names", names);
    file_->Close();
    target_.Commit();
  }

 private:
  AtomicFile target_;
  std::unique_ptr<Hdf5File> file_;
};

}  // namespace

std::unique_ptr<GridSource> OpenHdf5Grids(const std::filesystem::path& path) {
  return std::make_unique<Hdf5Reader>(path);
}

std::unique_ptr<GridSink> MakeHdf5Sink(const std::filesystem::path& path) {
  return std::make_unique<Hdf5Sink>(path);
}

}  // namespace antigrasp
