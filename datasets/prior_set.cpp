#include "antigrasp/datasets/prior_set.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "antigrasp/core/check.h"
#include "antigrasp/core/error.h"
#include "antigrasp/core/format.h"
#include "antigrasp/core/shared_stream.h"
#include "antigrasp/datasets/bottle.h"
#include "antigrasp/datasets/grafted_solid.h"
#include "antigrasp/sdf/pass_grid.h"
#include "antigrasp/sdf/remesh.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

// Shapes are drawn in a cube of side 1, the "design cube", and shrunk by the one factor that leaves
// kFreeCells cells free on each side (VI-C: the entire set is scaled alike).
double SetScale(int resolution) { return (resolution - 2.0 * kFreeCells) / resolution; }

// Uniform over all rotations: a normalised 4-D Gaussian is a uniform unit quaternion.
Eigen::Matrix3d DrawRotation(RngStream& rng) {
  const double w = rng.Normal(), x = rng.Normal(), y = rng.Normal(), z = rng.Normal();
  return Eigen::Quaterniond(w, x, y, z).normalized().toRotationMatrix();
}

Vector3d DrawSizes(RngStream& rng, const Vector3d& low, const Vector3d& high) {
  const double x = rng.Uniform(low.x(), high.x()), y = rng.Uniform(low.y(), high.y());
  return {x, y, rng.Uniform(low.z(), high.z())};
}

constexpr int kGrafts = 2;

// Full sizes of the parts in the design cube, and how a graft sits on the large part.
struct GraftRecipe {
  Primitive::Shape shape;
  Vector3d core_low, core_high;    // large part, axes along x, y, z
  Vector3d graft_low, graft_high;  // the third size is the long one
  double least_overhang;           // how far one end of a graft's axis is out of the large part
};

constexpr double kCylinderOverhang = 0.16;
constexpr double kPrismOverhang = 0.20;

// Grafts are at least five cells thick on a 32^3 grid: thinner ones are neither printed nor learnt.
GraftRecipe CylinderRecipe() {
  return {Primitive::Shape::kCylinder, {0.30, 0.30, 0.70}, {0.40, 0.40, 0.95},
          {0.18, 0.18, 0.45},          {0.27, 0.27, 0.75}, kCylinderOverhang};
}

GraftRecipe PrismRecipe() {
  return {Primitive::Shape::kBox, {0.38, 0.38, 0.55}, {0.62, 0.62, 0.90},
          {0.20, 0.20, 0.65},     {0.40, 0.40, 1.00}, kPrismOverhang};
}

Primitive DrawCore(const GraftRecipe& recipe, RngStream& rng) {
  Primitive core;
  core.shape = recipe.shape;
  core.half = 0.5 * DrawSizes(rng, recipe.core_low, recipe.core_high);
  if (core.shape == Primitive::Shape::kCylinder) core.half.y() = core.half.x();
  return core;
}

// A graft whose axis passes through a point inside the core.
Primitive DrawGraft(const GraftRecipe& recipe, const Primitive& core, RngStream& rng) {
  Primitive graft;
  graft.shape = recipe.shape;
  graft.half = 0.5 * DrawSizes(rng, recipe.graft_low, recipe.graft_high);
  if (graft.shape == Primitive::Shape::kCylinder) graft.half.y() = graft.half.x();
  graft.axes = DrawRotation(rng);
  const Vector3d inside =
      DrawSizes(rng, Vector3d::Constant(-0.6), Vector3d::Constant(0.6)).cwiseProduct(core.half);
  graft.center = inside + rng.Uniform(-0.8, 0.8) * graft.half.z() * graft.axes.col(2);
  return graft;
}

bool SticksOut(const Primitive& graft, const Primitive& core, double overhang) {
  const Vector3d reach = graft.half.z() * graft.axes.col(2);
  return std::min(SignedDistance(core, graft.center + reach),
                  SignedDistance(core, graft.center - reach)) < -overhang;
}

using Field = std::function<double(const Vector3d&)>;  // in the design cube, centred

// An empty field when the draw does not fit the design cube or hides a graft. Only `grafts` of the
// grafts stay, after all else is done.
Field DrawGrafted(const GraftRecipe& recipe, int grafts, RngStream& rng) {
  std::vector<Primitive> parts = {DrawCore(recipe, rng)};
  for (int i = 0; i < kGrafts; ++i) {
    parts.push_back(DrawGraft(recipe, parts[0], rng));
    if (!SticksOut(parts.back(), parts[0], recipe.least_overhang)) return {};
  }
  BoundingBox box = Bounds(parts[0]);
  for (const Primitive& part : parts) {
    box.min = box.min.cwiseMin(Bounds(part).min);
    box.max = box.max.cwiseMax(Bounds(part).max);
  }
  if (box.Extent().maxCoeff() > 1.0) return {};
  for (Primitive& part : parts) part.center -= box.Center();
  parts.resize(1 + static_cast<std::size_t>(grafts));
  const auto solid = std::make_shared<GraftedSolid>(std::move(parts));
  return [solid](const Vector3d& p) { return solid->SignedDistance(p); };
}

Field DrawBottle(RngStream& rng) {
  const int family = static_cast<int>(rng.Below(kBottleFamilies));
  const BottleProfile profile = SampleBottle(family, rng);
  // A surface of revolution asks for the same few radii again and again.
  auto known = std::make_shared<std::map<std::pair<double, double>, double>>();
  return [profile, known](const Vector3d& p) {
    const double radius = p.head<2>().norm();
    const auto [it, is_new] = known->try_emplace({radius, p.z()}, 0.0);
    if (is_new) it->second = SignedDistance(profile, radius, p.z());
    return it->second;
  };
}

// The one list of kinds.
struct Kind {
  const char* name;
  Field (*draw)(int grafts, RngStream& rng);  // nothing when this draw does not fit
  int grafts;                                 // of every shape
};
constexpr std::array<Kind, 3> kKinds = {{
    {"cylinders",
     [](int grafts, RngStream& rng) { return DrawGrafted(CylinderRecipe(), grafts, rng); },
     kGrafts},
    {"prisms", [](int grafts, RngStream& rng) { return DrawGrafted(PrismRecipe(), grafts, rng); },
     kGrafts},
    {"bottles", [](int, RngStream& rng) { return DrawBottle(rng); }, 0},
}};

const Kind& KindOf(const std::string& name) {
  for (const Kind& kind : kKinds) {
    if (kind.name == name) return kind;
  }
  std::string names;
  for (const Kind& kind : kKinds) names += (names.empty() ? "" : ", ") + std::string(kind.name);
  throw InputError("kind = \"" + name + "\"", "prior set", "one of " + names);
}

SdfGrid Sampled(const Field& field, int resolution) {
  SdfGrid grid = UnitCubeGrid(resolution);
  const double scale = SetScale(resolution);
  for (int z = 0; z < grid.n; ++z) {
    for (int y = 0; y < grid.n; ++y) {
      for (int x = 0; x < grid.n; ++x) {
        const double value = scale * field(grid.Node(x, y, z) / scale);
        grid.values[grid.Index(x, y, z)] = static_cast<float>(value);
      }
    }
  }
  return grid;
}

// Draws from the item's own stream until a shape fits and is a solid on this grid.
SdfGrid MakeShape(const PriorSetOptions& options, std::int64_t index) {
  constexpr int kMostDraws = 10'000;
  const auto draw = KindOf(options.kind).draw;
  RngStream rng(options.seed, "prior-" + options.kind, static_cast<std::uint64_t>(index));
  for (int attempt = 0; attempt < kMostDraws; ++attempt) {
    const Field field = draw(options.grafts, rng);
    if (!field) continue;
    SdfGrid grid = Sampled(field, options.resolution);
    if (Remesh(grid).ok()) return grid;
  }
  AG_CHECK(false, "no usable shape in " + std::to_string(kMostDraws) + " draws");
}

void CheckOptions(const PriorSetOptions& options) {
  const Kind& kind = KindOf(options.kind);
  if (options.grafts < 0 || options.grafts > kGrafts ||
      (options.grafts < kGrafts && kind.grafts == 0)) {
    throw InputError("grafts = " + std::to_string(options.grafts), "prior set " + options.kind,
                     "0, 1 or 2 of cylinders or prisms; bottles have none");
  }
  if (options.count < 1) {
    throw InputError("count = " + std::to_string(options.count), "prior set", "at least 1");
  }
  if (options.resolution < 16 || options.resolution > 256) {
    throw InputError("resolution = " + std::to_string(options.resolution), "prior set",
                     "a whole number in [16, 256]");
  }
}

// The set without its shapes.
ShapeSet About(const PriorSetOptions& options) {
  CheckOptions(options);
  return {options.kind, options.seed,
          "prior set " + options.kind + ", seed " + std::to_string(options.seed) + ", count " +
              std::to_string(options.count) +
              (options.grafts < kGrafts ? ", grafts " + std::to_string(options.grafts) : "")};
}

template <typename Take>  // take(name, grid)
void StreamShapes(WorkShare* share, const PriorSetOptions& options, const Take& take,
                  const ProgressFn& progress) {
  StreamShared(
      share, options.count, options.threads, [&](std::int64_t i) { return MakeShape(options, i); },
      [&](std::int64_t i, SdfGrid grid) { take(NumberedName(options.kind, i), std::move(grid)); },
      progress);
}

}  // namespace

std::vector<std::string> PriorSetKinds() {
  std::vector<std::string> names;
  for (const Kind& kind : kKinds) names.emplace_back(kind.name);
  return names;
}

ShapeSet MakePriorSet(const PriorSetOptions& options, const ProgressFn& progress,
                      WorkShare* share) {
  ShapeSet set = About(options);
  StreamShapes(
      share, options,
      [&](std::string name, SdfGrid grid) {
        set.names.push_back(std::move(name));
        set.grids.push_back(std::move(grid));
      },
      progress);
  return set;
}

std::string PriorSetText(const PriorSetOptions& options) {
  return std::to_string(options.count) + " " + options.kind + ", " +
         std::to_string(options.resolution) + "^3, seed " + std::to_string(options.seed);
}

void WritePriorSet(const std::filesystem::path& path, const PriorSetOptions& options,
                   const ProgressFn& progress, WorkShare* share) {
  std::optional<ShapeSetWriter> writer;
  const ShapeSet about = About(options);
  if (!Helps(share)) writer.emplace(path, about, static_cast<std::size_t>(options.count));
  StreamShapes(
      share, options,
      [&](std::string name, const SdfGrid& grid) { writer->Add(std::move(name), grid); }, progress);
  if (writer) writer->Commit();
}

}  // namespace antigrasp
