#include <algorithm>
#include <cmath>

#include "antigrasp/core/error.h"
#include "antigrasp/core/format.h"
#include "antigrasp/datasets/grid_check.h"
#include "antigrasp/datasets/grid_files.h"

namespace antigrasp {
namespace {

constexpr int kGridsLookedAt = 16;
constexpr double kSameCube = 1e-6;       // relative, of the cube's side
constexpr double kSlopeTolerance = 2.0;  // smoothed and learned distances are less steep

class Meant : public GridSource {
 public:
  Meant(ForeignGrids grids, const GridMeaning& meaning, std::string path)
      : grids_(std::move(grids)), path_(std::move(path)), info_(grids_.info) {
    cube_ = UnitCubeGrid(info_.n);
    cube_.values.clear();
    if (grids_.says) {
      RequireNothingMeant(meaning, path_);
      cube_.spacing = grids_.spacing;
      cube_.origin = grids_.origin;
    } else {
      if (meaning.sign == GridSign::kNegativeInside) sign_ = meaning.sign;
      const double spacing = meaning.spacing > 0.0  ? meaning.spacing
                             : grids_.spacing > 0.0 ? grids_.spacing
                                                    : cube_.spacing;
      const double side = spacing * info_.n;
      if (std::abs(side - 1.0) > kSameCube) {
        info_.side = side;
        scale_ = 1.0 / side;
      }
      info_.kind = "import";
      info_.provenance = "distances of " + path_;
    }
    info_.spacing = cube_.spacing;
    if (!grids_.says) Check();
  }

  const ShapeSetInfo& info() const override { return info_; }
  std::vector<std::string> Names() const override { return grids_.names; }
  SdfGrid Grid(int i) const override {
    SdfGrid grid = cube_;
    const auto n = static_cast<std::size_t>(info_.n);
    grid.values.resize(n * n * n);
    grids_.read(i, grid.values);
    const auto factor = static_cast<float>(sign_ == GridSign::kPositiveInside ? scale_ : -scale_);
    if (factor != 1.0F) {
      for (float& value : grid.values) value *= factor;
    }
    return grid;
  }

 private:
  // Samples of a network may be wrong one by one; what most of the first say counts.
  void Check() const {
    const int looked_at = std::min(info_.count, kGridsLookedAt);
    int turned = 0;
    std::vector<double> slopes;
    for (int i = 0; i < looked_at; ++i) {
      const SdfGrid grid = Grid(i);
      if (BorderInside(grid) > 0.5) ++turned;
      const double slope = SlopeAtSurface(grid) / grid.spacing;
      if (slope > 0.0) slopes.push_back(slope);
    }
    if (2 * turned > looked_at) {
      const bool positive = sign_ == GridSign::kPositiveInside;
      throw InputError(std::string("inside at the border where ") +
                           (positive ? "positive" : "negative") + " is inside",
                       path_,
                       "--sign " + std::string(positive ? "negative" : "positive") +
                           "-inside of antigrasp dataset import");
    }
    if (slopes.empty()) return;
    std::sort(slopes.begin(), slopes.end());
    const double slope = slopes[slopes.size() / 2];
    if (slope <= kSlopeTolerance && slope >= 1.0 / kSlopeTolerance) return;
    char steep[32], right[32];
    std::snprintf(steep, sizeof steep, "%.3g", slope);
    std::snprintf(right, sizeof right, "%.3g", slope * cube_.spacing / scale_);
    throw InputError(
        "values that change by " + std::string(steep) + " times the distance of the nodes", path_,
        "distances; if their unit is another, --spacing of antigrasp dataset import: about " +
            std::string(right));
  }

  ForeignGrids grids_;
  std::string path_;
  ShapeSetInfo info_;
  SdfGrid cube_{};  // without values
  GridSign sign_ = GridSign::kPositiveInside;
  double scale_ = 1.0;
};

}  // namespace

void RequireNothingMeant(const GridMeaning& meaning, const std::string& path) {
  const bool sign = meaning.sign != GridSign::kOfFile;
  if (!sign && meaning.spacing == 0.0) return;
  throw InputError(sign ? "--sign" : "--spacing", path, "none: the file says its sign and spacing");
}

std::unique_ptr<GridSource> MeantGrids(ForeignGrids grids, const GridMeaning& meaning,
                                       const std::filesystem::path& path) {
  return std::make_unique<Meant>(std::move(grids), meaning, path.string());
}

void RequireUsableSize(std::uint64_t count, std::uint64_t n, const std::string& where) {
  if (n >= 1 && n <= kMostNodes && count <= kMostGrids) return;
  throw InputError(std::to_string(count) + " grids of " + std::to_string(n) + " nodes a side",
                   where,
                   "at most " + std::to_string(kMostGrids) + " of 1 to " +
                       std::to_string(kMostNodes) + " nodes a side");
}

}  // namespace antigrasp
