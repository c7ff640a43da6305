#include "antigrasp/train/selection.h"

#include <torch/types.h>
#include <torch/utils.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "antigrasp/core/check.h"
#include "antigrasp/core/rng.h"
#include "antigrasp/sdf/mesh_to_sdf.h"
#include "antigrasp/train/elites.h"
#include "antigrasp/train/prior_similarity.h"

namespace antigrasp {
namespace {

// `count` of the given indices drawn without replacement, ascending; all of them if there are
// fewer.
std::vector<std::int64_t> Draw(const std::vector<std::int64_t>& from, std::int64_t count,
                               RngStream rng) {
  const std::vector<double> order = RandomOrder(std::vector<double>(from.size()), &rng);
  std::vector<std::int64_t> drawn;
  for (const std::int64_t i : LeastGraspable(order, count)) {
    drawn.push_back(from[static_cast<std::size_t>(i)]);
  }
  return drawn;
}

torch::Tensor Rows(const torch::Tensor& values, const std::vector<std::int64_t>& indices) {
  return values.index_select(0, torch::tensor(indices, torch::kLong));
}

// A cell's distance from the outermost nodes: marching cubes close what lies inside, and a
// generator's blur has room.
BoundingBox RoomFor(const SdfGrid& grid) {
  return {grid.Node(1, 1, 1), grid.Node(grid.n - 2, grid.n - 2, grid.n - 2)};
}

}  // namespace

EliteRefiner InThreads(MeshRefiner refine) {
  if (!refine) return nullptr;
  return
      [refine = std::move(refine)](const std::vector<RoughElite>& elites, const RunConfig& config,
                                   const BoundingBox& within, const ProgressFn& progress) {
        std::vector<TriangleMesh> refined(elites.size());
        ParallelFor(
            std::ssize(elites), config.threads,
            [&](std::int64_t i) {
              const RoughElite& elite = elites[static_cast<std::size_t>(i)];
              refined[static_cast<std::size_t>(i)] = refine(elite.mesh, config, within, elite.seed);
            },
            progress);
        return refined;
      };
}

EliteSelector::EliteSelector(const RunConfig& config, torch::Tensor prior, EliteRefiner refine)
    : config_(config), prior_(std::move(prior)), refine_(std::move(refine)) {
  AG_CHECK(!RefinesMeshes(config_.cem) || refine_, "somebody refines the elites");
  if (config_.cem.spread > 0.0 && prior_.size(0) > 1) spread_.emplace(prior_, config_.cem.spread);
  if (config_.cem.variant != EliteRule::kStratified) return;
  const std::vector<std::int64_t> chosen =
      Draw(Every(prior_.size(0)), config_.cem.cells, RngStream(config_.seed, "cells"));
  centres_ = Rows(prior_, chosen).flatten(1).to(torch::kFloat);
  residents_.resize(chosen.size());
  const std::vector<std::int64_t> cells = NearestRows(prior_, centres_);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    residents_[static_cast<std::size_t>(cells[i])].push_back(static_cast<std::int64_t>(i));
  }
}

torch::Tensor EliteSelector::WithoutOutside(const torch::Tensor& values, double share) const {
  if (!spread_) return values;
  constexpr double kNothing = -1.0;  // no node inside
  const std::vector<double> nearest = spread_->Nearest(values);
  torch::Tensor within = values.clone();
  for (std::int64_t i = 0; i < values.size(0); ++i) {
    const bool inside = nearest[static_cast<std::size_t>(i)] <= share * spread_->limit();
    if (!inside) within[i].fill_(kNothing);
  }
  return within;
}

std::int64_t EliteSelector::LeaveOutside(const torch::Tensor& values,
                                         std::vector<double>* order) const {
  if (!spread_) return 0;
  const std::vector<double> nearest = spread_->Nearest(values);
  std::int64_t outside = 0;
  for (std::size_t i = 0; i < order->size(); ++i) {
    if (std::isnan((*order)[i]) || nearest[i] <= spread_->limit()) continue;
    (*order)[i] = std::numeric_limits<double>::quiet_NaN();
    ++outside;
  }
  return outside;
}

Selection EliteSelector::Select(const ScoredStage& scored, int episode) const {
  const CemOptions& cem = config_.cem;
  const auto stage = static_cast<std::uint64_t>(episode);
  RngStream chance(config_.seed, "control", stage);
  std::vector<double> order = cem.select == EliteOrder::kRandom
                                  ? RandomOrder(scored.graspabilities, &chance)
                                  : scored.graspabilities;
  Selection selection;
  selection.outside = LeaveOutside(scored.values, &order);
  if (cem.variant == EliteRule::kStratified) {
    std::vector<double> weight;
    for (const auto& residents : residents_) weight.push_back(double(residents.size()));
    SharedElites shared =
        LeastGraspableByCell(order, NearestRows(scored.values, centres_), weight, cem.keep);
    selection.elites = std::move(shared.elites);
    for (std::size_t c = 0; c < residents_.size(); ++c) {
      const auto stand_ins =
          Draw(residents_[c], shared.missing[c], RngStream(config_.seed, "stand-in", stage, c));
      selection.replayed.insert(selection.replayed.end(), stand_ins.begin(), stand_ins.end());
    }
  } else if (cem.variant == EliteRule::kDiverse) {
    selection.elites = DominatedNovelty(order, ValueDistances(scored.values, scored.values),
                                        cem.keep, cem.neighbours);
  } else {
    selection.elites = LeastGraspable(order, cem.keep);
  }
  const auto mixed_in = std::llround(cem.prior_fraction * double(selection.elites.size()));
  const auto drawn =
      Draw(Every(prior_.size(0)), mixed_in, RngStream(config_.seed, "replay", stage));
  selection.replayed.insert(selection.replayed.end(), drawn.begin(), drawn.end());
  return selection;
}

torch::Tensor EliteSelector::Elites(const ScoredStage& scored, const Selection& selection,
                                    int episode, const ProgressFn& progress) const {
  if (!RefinesMeshes(config_.cem) && !config_.cem.redistance) {
    return Rows(scored.values, selection.elites);
  }
  return ExactValues(scored, selection.elites, episode, progress);
}

// Network values of the distances to the meshes. What a grid holds far from its surface, or never
// closed into one, is gone.
torch::Tensor EliteSelector::ExactValues(const ScoredStage& scored,
                                         const std::vector<std::int64_t>& indices, int episode,
                                         const ProgressFn& progress) const {
  ShapeSet exact;
  exact.grids.assign(indices.size(), UnitCubeGrid(config_.model.resolution));
  const auto mesh = [&](std::size_t i) -> const TriangleMesh& {
    return scored.objects[static_cast<std::size_t>(indices[i])].mesh;
  };
  std::vector<TriangleMesh> refined;
  const bool refine = RefinesMeshes(config_.cem);
  if (refine) {
    std::vector<RoughElite> rough;
    for (std::size_t i = 0; i < indices.size(); ++i) {
      RngStream rng(config_.seed, "refine", static_cast<std::uint64_t>(episode),
                    static_cast<std::uint64_t>(indices[i]));
      rough.push_back({mesh(i), rng.NextU64()});
    }
    refined = refine_(rough, config_, RoomFor(UnitCubeGrid(config_.model.resolution)), progress);
  }
  ParallelFor(
      std::ssize(indices), config_.threads,
      [&](std::int64_t i) {
        const auto slot = static_cast<std::size_t>(i);
        MeshToSdf(refine ? refined[slot] : mesh(slot), &exact.grids[slot]);
      },
      refine ? ProgressFn() : progress);
  return NetworkValuesOf(exact, config_.model, "the elites");
}

torch::Tensor EliteSelector::TrainingSet(const torch::Tensor& elites,
                                         const Selection& selection) const {
  const torch::Tensor learnt = elites.to(torch::kHalf);
  if (selection.replayed.empty()) return learnt;
  return torch::cat({learnt, Rows(prior_, selection.replayed)});
}

}  // namespace antigrasp
