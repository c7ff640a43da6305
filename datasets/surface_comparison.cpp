#include "antigrasp/datasets/surface_comparison.h"

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

void AddPoints(const std::vector<TriangleMesh>& meshes, const std::vector<std::uint64_t>& streams,
               Stream set, const SurfaceComparisonOptions& options, const Eigen::Vector3d& place,
               std::vector<PointSet>* points) {
  AG_CHECK(streams.empty() || streams.size() == meshes.size(), "a stream each, or none");
  std::vector<std::optional<PointSet>> slots(meshes.size());
  ParallelFor(static_cast<std::int64_t>(meshes.size()), options.threads, [&](std::int64_t i) {
    const auto slot = static_cast<std::size_t>(i);
    slots[slot] = SurfacePoints(meshes[slot], options.points, options.seed, set,
                                streams.empty() ? slot : streams[slot], place);
  });
  for (auto& slot : slots) points->push_back(std::move(*slot));
}

template <typename Measure>
double MeanOver(const std::vector<TriangleMesh>& meshes, int threads, const Measure& measure) {
  std::vector<double> values(meshes.size());
  ParallelFor(static_cast<std::int64_t>(meshes.size()), threads, [&](std::int64_t i) {
    values[static_cast<std::size_t>(i)] = measure(meshes[static_cast<std::size_t>(i)]);
  });
  return MeanWithInterval(values).mean;
}

// All but the Vendi score, which needs the distances.
SetLook LookOf(const std::vector<TriangleMesh>& meshes, const double* floors, int threads) {
  SetLook look;
  look.size = MeanOver(meshes, threads,
                       [](const TriangleMesh& mesh) { return Bounds(mesh).Extent().norm(); });
  look.roughness = MeanOver(meshes, threads, MeanDihedralAngle);
  look.floor = MeanWithInterval({floors, floors + meshes.size()}).mean;
  return look;
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

// `points`: the samples, then as many of the reference.
Memorisation MemorisationOf(const std::vector<PointSet>& points,
                            const std::vector<TriangleMesh>& training,
                            const std::vector<std::uint64_t>& streams,
                            const SurfaceComparisonOptions& options, const Eigen::Vector3d& place,
                            const ProgressFn& progress) {
  std::vector<PointSet> others;
  AddPoints(training, streams, kTraining, options, place, &others);
  const std::vector<double> nearest = NearestChamfer(points, others, options.threads, progress);
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
  const DistanceMatrix all = ChamferMatrix(points, options.threads, progress("distances"));
  const std::vector<double> floors = Floors(points, again, options.threads);
  const DistanceMatrix clean = WithoutFloors(all, floors);
  const auto n = static_cast<Eigen::Index>(samples.size());

  SurfaceComparison result;
  result.sets =
      CompareSets(all.topLeftCorner(n, n), all.topRightCorner(n, n), all.bottomRightCorner(n, n));
  result.spread = CompareSpreads(clean.topLeftCorner(n, n), clean.bottomRightCorner(n, n));
  result.samples = LookOf(samples, floors.data(), options.threads);
  result.reference = LookOf(reference, floors.data() + n, options.threads);
  const double scale = 0.5 * result.spread.median_distance;
  result.samples.vendi = VendiScore(clean.topLeftCorner(n, n), scale);
  result.reference.vendi = VendiScore(clean.bottomRightCorner(n, n), scale);
  if (!training.empty()) {
    result.memorisation = MemorisationOf(points, training, streams.training, options, place,
                                         progress("distances to the training shapes"));
  }
  return result;
}

}  // namespace antigrasp
