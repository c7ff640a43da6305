#include "antigrasp/datasets/surface_comparison.h"

#include <cmath>

#include "antigrasp/core/check.h"
#include "antigrasp/core/statistics.h"
#include "antigrasp/datasets/roughness.h"
#include "antigrasp/mesh/place.h"

namespace antigrasp {
namespace {

// Numbers of the sets' random streams.
enum Stream : std::uint64_t { kSamples, kReference, kTraining, kSamplesAgain, kReferenceAgain };

// Of all the shapes together: what is compared is where they lie to each other.
Eigen::Vector3d CommonPlace(std::initializer_list<const std::vector<TriangleMesh>*> sets) {
  TriangleMesh corners;
  for (const auto* set : sets) {
    for (const TriangleMesh& mesh : *set) {
      const BoundingBox box = Bounds(mesh);
      corners.vertices.insert(corners.vertices.end(), {box.min, box.max});
    }
  }
  return RoundPlace(corners);
}

// Adds draw(mesh, stream) of every mesh.
template <int D, typename Draw>
void AddDrawn(const std::vector<TriangleMesh>& meshes, const std::vector<std::uint64_t>& streams,
              int threads, const Draw& draw, std::vector<PointBlocks<D>>* points) {
  AG_CHECK(streams.empty() || streams.size() == meshes.size(), "a stream each, or none");
  std::vector<std::optional<PointBlocks<D>>> slots(meshes.size());
  ParallelFor(static_cast<std::int64_t>(meshes.size()), threads, [&](std::int64_t i) {
    const auto slot = static_cast<std::size_t>(i);
    slots[slot] = draw(meshes[slot], streams.empty() ? slot : streams[slot]);
  });
  for (auto& slot : slots) points->push_back(std::move(*slot));
}

void AddPoints(const std::vector<TriangleMesh>& meshes, const std::vector<std::uint64_t>& streams,
               Stream set, const SurfaceComparisonOptions& options, const Eigen::Vector3d& place,
               std::vector<PointSet>* points) {
  const auto draw = [&](const TriangleMesh& mesh, std::uint64_t stream) {
    return SurfacePoints(mesh, options.points, options.seed, set, stream, place);
  };
  AddDrawn(meshes, streams, options.threads, draw, points);
}

// The same points with their normals, `length` long.
void AddOriented(const std::vector<TriangleMesh>& meshes, const std::vector<std::uint64_t>& streams,
                 Stream set, const SurfaceComparisonOptions& options, double length,
                 const Eigen::Vector3d& place, std::vector<OrientedPointSet>* points) {
  const auto draw = [&](const TriangleMesh& mesh, std::uint64_t stream) {
    return OrientedSurfacePoints(mesh, options.points, options.seed, set, stream, length, place);
  };
  AddDrawn(meshes, streams, options.threads, draw, points);
}

// `all`: distances of the samples, then of the reference.
SetComparison CompareHalves(const DistanceMatrix& all) {
  const Eigen::Index n = all.rows() / 2;
  return CompareSets(all.topLeftCorner(n, n), all.topRightCorner(n, n),
                     all.bottomRightCorner(n, n));
}

template <typename Measure>
double MeanOver(const std::vector<TriangleMesh>& meshes, int threads, const Measure& measure) {
  std::vector<double> values(meshes.size());
  ParallelFor(static_cast<std::int64_t>(meshes.size()), threads, [&](std::int64_t i) {
    values[static_cast<std::size_t>(i)] = measure(meshes[static_cast<std::size_t>(i)]);
  });
  return MeanWithInterval(values).mean;
}

// Mean diagonal.
double SizeOf(const std::vector<TriangleMesh>& meshes, int threads) {
  return MeanOver(meshes, threads,
                  [](const TriangleMesh& mesh) { return Bounds(mesh).Extent().norm(); });
}

DihedralAngles AnglesOf(const std::vector<TriangleMesh>& meshes, int threads) {
  std::vector<DihedralAngles> angles(meshes.size());
  ParallelFor(static_cast<std::int64_t>(meshes.size()), threads, [&](std::int64_t i) {
    const auto slot = static_cast<std::size_t>(i);
    angles[slot] = DihedralAnglesOf(meshes[slot]);
  });
  return MeanOf(angles);
}

// All but the shares of the angles, which the sets' distance needs too, and the Vendi score, which
// needs the distances.
SetLook LookOf(const std::vector<TriangleMesh>& meshes, const double* floors, int threads) {
  SetLook look;
  look.size = SizeOf(meshes, threads);
  look.roughness = MeanOver(meshes, threads, MeanDihedralAngle);
  look.floor = MeanWithInterval({floors, floors + meshes.size()}).mean;
  return look;
}

void CompareAngles(const std::vector<TriangleMesh>& samples,
                   const std::vector<TriangleMesh>& reference, int threads,
                   SurfaceComparison* result) {
  const DihedralAngles a = AnglesOf(samples, threads), b = AnglesOf(reference, threads);
  result->samples.flat = a.flat;
  result->samples.crease = a.crease;
  result->reference.flat = b.flat;
  result->reference.crease = b.crease;
  result->dihedral_distance = DihedralDistance(a, b);
}

// Each shape's points against another sampling of it.
std::vector<double> Floors(const std::vector<PointSet>& points, const std::vector<PointSet>& again,
                           int threads) {
  std::vector<double> floors(points.size());
  ParallelFor(static_cast<std::int64_t>(points.size()), threads, [&](std::int64_t i) {
    const auto slot = static_cast<std::size_t>(i);
    floors[slot] = Chamfer(points[slot], again[slot]);
  });
  return floors;
}

// `nearest` training shape: of the samples, then of as many of the reference.
Memorisation MemorisationOf(const std::vector<double>& nearest) {
  const auto half = nearest.begin() + static_cast<std::ptrdiff_t>(nearest.size() / 2);
  const std::vector<double> samples(nearest.begin(), half), reference(half, nearest.end());
  const double median = DiscretePercentile(reference, 50.0);
  Memorisation result;
  result.samples = MeanWithInterval(samples).mean;
  result.reference = MeanWithInterval(reference).mean;
  for (const double distance : samples) result.nearer += distance < median;
  result.nearer /= static_cast<double>(samples.size());
  return result;
}

}  // namespace

double NormalLength(double weight, double diagonal) {
  return weight * diagonal / std::sqrt(12.0);  // a ball of radius 1 lies in a cube of side 2
}

SurfaceComparison CompareSurfaces(const std::vector<TriangleMesh>& samples,
                                  const std::vector<TriangleMesh>& reference,
                                  const std::vector<TriangleMesh>& training,
                                  const SurfaceComparisonOptions& options, const PhaseFn& phase,
                                  const SurfaceStreams& streams) {
  AG_CHECK(samples.size() == reference.size(), "sets of the same size");
  AG_CHECK(samples.size() >= 2, "two sets of at least two shapes");
  const auto progress = [&](const char* name) { return phase ? phase(name) : ProgressFn(); };
  std::vector<PointSet> points, again;
  const Eigen::Vector3d place = CommonPlace({&samples, &reference, &training});
  AddPoints(samples, streams.samples, kSamples, options, place, &points);
  AddPoints(reference, streams.reference, kReference, options, place, &points);
  AddPoints(samples, streams.samples, kSamplesAgain, options, place, &again);
  AddPoints(reference, streams.reference, kReferenceAgain, options, place, &again);
  const DistanceMatrix all =
      ChamferMatrix(points, options.threads, progress("distances"), options.share);
  DistanceMatrix with_normals;
  if (options.normals > 0.0) {
    std::vector<OrientedPointSet> oriented;
    const double length = NormalLength(options.normals, SizeOf(reference, options.threads));
    AddOriented(samples, streams.samples, kSamples, options, length, place, &oriented);
    AddOriented(reference, streams.reference, kReference, options, length, place, &oriented);
    with_normals =
        ChamferMatrix(oriented, options.threads, progress("distances with normals"), options.share);
  }
  std::vector<double> nearest;
  if (!training.empty()) {
    std::vector<PointSet> others;
    AddPoints(training, streams.training, kTraining, options, place, &others);
    nearest = NearestChamfer(points, others, options.threads,
                             progress("distances to the training shapes"), options.share);
  }
  if (Helps(options.share)) return {};
  const std::vector<double> floors = Floors(points, again, options.threads);
  const DistanceMatrix clean = WithoutFloors(all, floors);
  const auto n = static_cast<Eigen::Index>(samples.size());

  SurfaceComparison result;
  result.sets = CompareHalves(all);
  result.spread = CompareSpreads(clean.topLeftCorner(n, n), clean.bottomRightCorner(n, n));
  result.samples = LookOf(samples, floors.data(), options.threads);
  result.reference = LookOf(reference, floors.data() + n, options.threads);
  CompareAngles(samples, reference, options.threads, &result);
  if (options.normals > 0.0) result.normals = CompareHalves(with_normals);
  const double scale = 0.5 * result.spread.median_distance;
  result.samples.vendi = VendiScore(clean.topLeftCorner(n, n), scale);
  result.reference.vendi = VendiScore(clean.bottomRightCorner(n, n), scale);
  if (!training.empty()) result.memorisation = MemorisationOf(nearest);
  return result;
}

}  // namespace antigrasp
