#include "antigrasp/datasets/compared_set.h"

#include <algorithm>
#include <utility>

#include "antigrasp/core/error.h"
#include "antigrasp/core/rng.h"

namespace antigrasp {

ComparedSet ReadComparedSet(const std::string& input, LengthUnit units, int threads,
                            const ProgressFn& progress) {
  return ComparedSetOf(
      input, LoadObjects(ObjectSource({input}, GridUnit::kCube, units), threads, progress), units);
}

ComparedSet ComparedSetOf(std::string input, std::vector<InputObject> objects, LengthUnit units) {
  ComparedSet set;
  set.input = std::move(input);
  std::vector<std::string> statuses;
  for (InputObject& object : objects) {
    statuses.push_back(object.status);
    if (object.ok() && SurfaceArea(object.mesh) > 0.0) {
      // The whole name: points of two shapes of one set are never drawn alike.
      set.streams.push_back(HashOf(FileNameOf(object.name)));
      set.meshes.push_back(units == LengthUnit::kM
                               ? std::move(object.mesh)
                               : Transformed(object.mesh, MetresPer(units), {0.0, 0.0, 0.0}));
    } else {
      ++set.left_out;
    }
  }
  set.counts = CountByStatus(statuses);
  return set;
}

void RequireShapes(const ComparedSet& set, std::size_t least) {
  if (set.meshes.size() >= least) return;
  throw InputError(std::to_string(set.meshes.size()) + " solids", set.input,
                   "at least " + std::to_string(least));
}

void KeepAtRandom(std::size_t count, std::uint64_t seed, std::uint64_t number, ComparedSet* set) {
  std::vector<std::pair<std::uint64_t, std::size_t>> lots;
  for (std::size_t i = 0; i < set->streams.size(); ++i) {
    lots.emplace_back(RngStream(seed, "compared shapes", number, set->streams[i]).NextU64(), i);
  }
  std::sort(lots.begin(), lots.end());
  lots.resize(std::min(count, lots.size()));
  std::sort(lots.begin(), lots.end(),
            [](const auto& a, const auto& b) { return a.second < b.second; });
  std::vector<TriangleMesh> meshes;
  std::vector<std::uint64_t> streams;
  for (const auto& [lot, i] : lots) {
    meshes.push_back(std::move(set->meshes[i]));
    streams.push_back(set->streams[i]);
  }
  set->meshes = std::move(meshes);
  set->streams = std::move(streams);
}

std::size_t KeepAsMany(int most, std::uint64_t seed, ComparedSet* samples, ComparedSet* reference) {
  const std::size_t count =
      std::min({static_cast<std::size_t>(most), samples->meshes.size(), reference->meshes.size()});
  KeepAtRandom(count, seed, 0, samples);
  KeepAtRandom(count, seed, 1, reference);
  return count;
}

}  // namespace antigrasp
