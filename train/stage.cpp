#include "antigrasp/train/stage.h"

#include <torch/types.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>

#include "antigrasp/core/error.h"
#include "antigrasp/core/parallel.h"
#include "antigrasp/core/rng.h"
#include "antigrasp/datasets/roughness.h"
#include "antigrasp/models/sdf_values.h"
#include "antigrasp/quality/score_table.h"
#include "antigrasp/train/prior_similarity.h"
#include "antigrasp/train/sample_name.h"

namespace antigrasp {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

void FillSimilarity(const ScoredStage& scored, const torch::Tensor& prior, int compared,
                    StageStatistics* row) {
  std::vector<std::int64_t> valid;
  for (std::size_t i = 0; i < scored.objects.size(); ++i) {
    if (scored.objects[i].ok()) valid.push_back(static_cast<std::int64_t>(i));
  }
  const auto n = std::min<std::int64_t>({static_cast<std::int64_t>(valid.size()), prior.size(0),
                                         static_cast<std::int64_t>(compared)});
  if (n < 2) return;
  valid.resize(static_cast<std::size_t>(n));
  const PriorSimilarity similarity = CompareWithPrior(
      scored.values.index_select(0, torch::tensor(valid, torch::kLong)), prior.slice(0, 0, n));
  row->coverage = similarity.coverage;
  row->nna = similarity.nna;
  row->duplicates = similarity.duplicates;
  row->diversity = similarity.diversity;
}

void FillAngles(const ScoredStage& scored, int threads, StageStatistics* row) {
  std::vector<double> flat(scored.objects.size(), kNaN), crease(flat);
  ParallelFor(std::ssize(scored.objects), threads, [&](std::int64_t i) {
    const auto slot = static_cast<std::size_t>(i);
    if (!scored.objects[slot].ok()) return;
    const DihedralAngles angles = DihedralAnglesOf(scored.objects[slot].mesh);
    flat[slot] = angles.flat;
    crease[slot] = angles.crease;
  });
  const MeanInterval mean = MeanWithInterval(flat);
  if (mean.count == 0) return;
  row->flat = mean.mean;
  row->crease = MeanWithInterval(crease).mean;
}

// As many objects as values, none of them made.
ScoredStage Unscored(const torch::Tensor& values) {
  const auto count = static_cast<std::size_t>(values.size(0));
  ScoredStage scored;
  scored.values = values;
  scored.objects.resize(count);
  scored.scores.resize(count);
  scored.graspabilities.assign(count, kNaN);
  return scored;
}

RemeshResult ObjectOf(const torch::Tensor& value, const RunConfig& config) {
  const RemeshOptions remesh{.check_self_intersection = config.cem.check_self_intersection};
  return Remesh(GridOf(value, config.model), remesh);
}

}  // namespace

std::vector<std::int64_t> Every(std::int64_t count) {
  std::vector<std::int64_t> all(static_cast<std::size_t>(count));
  std::iota(all.begin(), all.end(), 0);
  return all;
}

SdfGrid GridOf(const torch::Tensor& value, const ModelOptions& model) {
  const torch::Tensor distances = Distances(value.to(torch::kFloat), model).contiguous();
  SdfGrid grid = UnitCubeGrid(model.resolution);
  const float* data = distances.data_ptr<float>();
  grid.values.assign(data, data + distances.numel());
  return grid;
}

torch::Tensor NetworkValuesOf(const ShapeSet& set, const ModelOptions& model,
                              const std::string& origin) {
  const std::int64_t n = model.resolution;
  const auto count = static_cast<std::int64_t>(set.grids.size());
  if (count == 0) throw InputError("no shapes", origin, "an SDF file with at least one shape");
  torch::Tensor values = torch::empty({count, 1, n, n, n}, torch::kHalf);
  for (std::int64_t i = 0; i < count; ++i) {
    const SdfGrid& grid = set.grids[static_cast<std::size_t>(i)];
    if (grid.n != model.resolution) {
      throw InputError("grids of " + std::to_string(grid.n) + "^3", origin,
                       "grids of " + std::to_string(n) + "^3");
    }
    const torch::Tensor distances = torch::from_blob(const_cast<float*>(grid.values.data()),
                                                     {1, n, n, n}, torch::kFloat);  // only read
    const torch::Tensor network = NetworkValues(distances, model);
    if (!network.isfinite().all().item<bool>()) {
      throw InputError("non-finite distances in shape " + std::to_string(i), origin,
                       "finite distances");
    }
    values[i].copy_(network);
  }
  return values;
}

std::uint64_t StageSeed(const RunConfig& config, int episode) {
  return RngStream(config.seed, "stage", static_cast<std::uint64_t>(episode)).NextU64();
}

ScoredStage ScoreStage(const torch::Tensor& values, const RunConfig& config,
                       const std::string& name, RunObserver* observer) {
  return ScoreSamples(values, Every(values.size(0)), config, PhaseOf(observer, name));
}

ScoredStage ScoreSamples(const torch::Tensor& values, const std::vector<std::int64_t>& indices,
                         const RunConfig& config, const ProgressFn& progress) {
  ScoredStage scored = Unscored(values);
  scored.scores = ScoreAll(
      values.size(0),
      [&](std::int64_t i) {
        RemeshResult& object = scored.objects[static_cast<std::size_t>(i)];
        object = ObjectOf(values[i], config);
        return object.ok() ? &object.mesh : nullptr;
      },
      [&](std::int64_t i) {
        return static_cast<std::uint64_t>(indices[static_cast<std::size_t>(i)]);
      },
      config.metric, config.seed, config.threads, progress);
  for (std::size_t i = 0; i < scored.scores.size(); ++i) {
    if (scored.scores[i].status == GraspabilityStatus::kNotEvaluable) continue;
    scored.graspabilities[i] = scored.scores[i].value;
  }
  return scored;
}

ScoredStage ScoreStageBy(const MeshScore& score, const torch::Tensor& values,
                         const RunConfig& config, const ProgressFn& progress) {
  ScoredStage scored = Unscored(values);
  ParallelFor(
      values.size(0), config.threads,
      [&](std::int64_t i) {
        const auto slot = static_cast<std::size_t>(i);
        scored.objects[slot] = ObjectOf(values[i], config);
        if (!scored.objects[slot].ok()) return;
        scored.graspabilities[slot] = score(scored.objects[slot].mesh);
        if (std::isnan(scored.graspabilities[slot])) return;
        scored.scores[slot].status = GraspabilityStatus::kOk;
        scored.scores[slot].value = scored.graspabilities[slot];
      },
      progress);
  return scored;
}

ScoredStage ScoreStageBy(Judge* judge, const torch::Tensor& values, const RunConfig& config,
                         const ProgressFn& progress) {
  return JudgeSamples(judge, values, Every(values.size(0)), config, progress);
}

ScoredStage JudgeSamples(Judge* judge, const torch::Tensor& values,
                         const std::vector<std::int64_t>& indices, const RunConfig& config,
                         const ProgressFn& progress) {
  ScoredStage scored = Unscored(values);
  const std::int64_t count = values.size(0);
  const auto report = [&](std::int64_t done) {
    if (progress) progress(done, 2 * count);
  };
  ParallelFor(
      count, config.threads,
      [&](std::int64_t i) {
        scored.objects[static_cast<std::size_t>(i)] = ObjectOf(values[i], config);
      },
      [&](std::int64_t done, std::int64_t) { report(done); });
  std::vector<JudgedObject> batch;
  std::vector<std::size_t> place_of;
  const auto judge_batch = [&] {
    if (batch.empty()) return;
    const std::vector<Verdict> verdicts = judge->Score(batch);
    for (std::size_t k = 0; k < verdicts.size(); ++k) {
      if (!verdicts[k].score) continue;
      scored.graspabilities[place_of[k]] = *verdicts[k].score;
      scored.scores[place_of[k]].status = GraspabilityStatus::kOk;
      scored.scores[place_of[k]].value = *verdicts[k].score;
    }
    if (!judge->Stopped().empty()) throw RuntimeFailure("the judge stopped: " + judge->Stopped());
    batch.clear();
    place_of.clear();
  };
  for (std::int64_t i = 0; i < count; ++i) {
    const auto slot = static_cast<std::size_t>(i);
    if (scored.objects[slot].ok()) {
      batch.push_back({SampleName(indices[slot]), &scored.objects[slot].mesh,
                       static_cast<std::uint64_t>(indices[slot])});
      place_of.push_back(slot);
    }
    if (batch.size() >= judge->BatchSize() || i + 1 == count) {
      judge_batch();
      report(count + i + 1);
    }
  }
  return scored;
}

StageStatistics Summarize(int stage, const ScoredStage& scored, const torch::Tensor& prior,
                          const RunConfig& config) {
  StageStatistics row;
  row.stage = stage;
  row.samples = static_cast<int>(scored.objects.size());
  for (const RemeshResult& object : scored.objects) {
    ++row.by_status[static_cast<std::size_t>(object.status)];
  }
  for (const Graspability& score : scored.scores) {
    row.scored += score.status != GraspabilityStatus::kNotEvaluable ? 1 : 0;
    row.without_grasps += score.status == GraspabilityStatus::kNoGrasps ? 1 : 0;
  }
  row.graspability = MeanWithInterval(scored.graspabilities);
  row.elite_threshold = kNaN;
  row.coverage = row.nna = row.duplicates = row.diversity = kNaN;
  if (stage >= 0) FillSimilarity(scored, prior, config.cem.compared, &row);
  FillAngles(scored, config.threads, &row);
  return row;
}

std::string StageScoresCsv(int stage, const ScoredStage& scored) {
  std::vector<ScoreRow> rows;
  for (std::size_t i = 0; i < scored.objects.size(); ++i) {
    const bool ok = scored.objects[i].ok();
    rows.push_back(
        {stage < 0 ? std::to_string(i) : SampleName(static_cast<std::int64_t>(i)),
         std::string(ok ? Name(scored.scores[i].status) : Name(scored.objects[i].status)),
         SummaryOf(scored.scores[i])});
  }
  return ScoresCsv(rows);
}

}  // namespace antigrasp
