#include "antigrasp/train/run_output.h"

#include <spdlog/spdlog.h>
#include <torch/types.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/csv_writer.h"
#include "antigrasp/mesh/fit.h"
#include "antigrasp/mesh/mesh_file.h"
#include "antigrasp/models/sdf_values.h"
#include "antigrasp/render/contact_sheet.h"
#include "antigrasp/train/elites.h"
#include "antigrasp/train/sample_name.h"

namespace antigrasp {
namespace {

std::string KappaText(const StageStatistics& row, const std::vector<StageStatistics>& rows) {
  const StageStatistics* prior = FindStage(rows, -1);
  if (row.stage < 0 || prior == nullptr) return "";
  const MeanInterval kappa = Ratio(row.graspability, prior->graspability);
  return ", " + MeanText(kappa, 2) + " of the prior set";
}

}  // namespace

std::string StageName(int episode) {
  return episode < 0 ? "prior set" : "episode " + std::to_string(episode);
}

std::string StageName(int episode, const std::string& doing) {
  return StageName(episode) + ": " + doing;
}

std::vector<std::pair<std::string, double>> StageScalars(const StageStatistics& row,
                                                         const std::vector<StageStatistics>& rows) {
  const StageStatistics* prior = FindStage(rows, -1);
  const double rejected = row.samples > 0 ? double(row.rejected()) / row.samples : 0.0;
  std::vector<std::pair<std::string, double>> scalars = {
      {"stage/graspability", row.graspability.mean},
      {"stage/rejected", rejected},
      {"stage/coverage", row.coverage},
      {"stage/near_duplicates", row.duplicates},
      {"stage/diversity", row.diversity},
      {"stage/1-NNA", row.nna},
      {"stage/flat_share", row.flat},
      {"stage/crease_share", row.crease}};
  if (prior != nullptr) {
    scalars.emplace_back("stage/kappa", Ratio(row.graspability, prior->graspability).mean);
  }
  return scalars;
}

void LogStage(const StageStatistics& row, const std::vector<StageStatistics>& rows) {
  const std::string name = row.stage < 0 ? "prior set" : "episode " + std::to_string(row.stage);
  spdlog::info("{}: {} objects, {} rejected, graspability {}{}", name, row.samples, row.rejected(),
               MeanText(row.graspability, 5), KappaText(row, rows));
}

void WarnIfCollapsed(const StageStatistics& row, const std::vector<StageStatistics>& rows) {
  const StageStatistics* first = FindStage(rows, 0);
  if (first != nullptr && row.coverage < 0.5 * first->coverage) {
    spdlog::warn(
        "the generator is collapsing: coverage {:.0f} % of the prior set, {:.0f} % in "
        "episode 0",
        100 * row.coverage, 100 * first->coverage);
  }
  if (row.duplicates > 0.2) {
    spdlog::warn("the generator is collapsing: {:.0f} % of its samples are near-duplicates",
                 100 * row.duplicates);
  }
}

void WriteElites(const std::filesystem::path& path, const torch::Tensor& values,
                 const std::vector<std::int64_t>& elites, int episode, const RunConfig& config) {
  ShapeSet set;
  set.kind = "elites";
  set.seed = config.seed;
  set.truncation = LargestDistance(config.model);
  set.provenance =
      "antigrasp train, episode " + std::to_string(episode) + ", " +
      (config.cem.select == EliteOrder::kRandom ? "random samples" : "least graspable samples");
  for (std::size_t k = 0; k < elites.size(); ++k) {
    set.names.push_back(SampleName(elites[k]));
    set.grids.push_back(GridOf(values[static_cast<std::int64_t>(k)], config.model));
  }
  WriteShapeSet(path, set);
}

void WriteSampleSheet(const std::filesystem::path& path, const ScoredStage& scored,
                      const RunConfig& config) {
  constexpr std::size_t kColumns = 8, kRows = 4;
  View view;
  view.pixels = 160;
  std::vector<std::vector<const TriangleMesh*>> rows;
  std::size_t drawn = 0;
  for (const auto& object : scored.objects) {
    if (object.mesh.faces.empty() || drawn == kColumns * kRows) continue;
    if (drawn++ % kColumns == 0) rows.emplace_back();
    rows.back().push_back(&object.mesh);
  }
  if (drawn > 0) WritePng(path, ContactSheet(rows, view, config.threads));
}

void ExportLeastGraspable(const ScoredStage& scored, const RunConfig& config,
                          const RunFolder& folder) {
  if (config.stl_count == 0) return;
  std::vector<std::int64_t> worst = LeastGraspable(scored.graspabilities, config.stl_count);
  const auto value = [&](std::int64_t i) {
    return scored.graspabilities[static_cast<std::size_t>(i)];
  };
  std::stable_sort(worst.begin(), worst.end(),
                   [&](std::int64_t a, std::int64_t b) { return value(a) < value(b); });
  MakeFolder(folder.Stl());
  const auto mesh = [&](std::int64_t rank) {
    const auto object = static_cast<std::size_t>(worst[static_cast<std::size_t>(rank)]);
    return &scored.objects[object].mesh;
  };
  const auto stream = [&](std::int64_t rank) {
    return static_cast<std::uint64_t>(worst[static_cast<std::size_t>(rank)]);
  };
  std::vector<Graspability> again(worst.size());
  if (config.cem.score == kEpsilonScore) {
    again = ScoreAll(std::ssize(worst), mesh, stream, config.metric, FreshSeed(config.seed),
                     config.threads);
  } else {  // of another judge there are no fresh draws
    for (Graspability& none : again) none.value = none.ci_low = none.ci_high = std::nan("");
  }
  CsvWriter csv({"file", "object", "graspability", "graspability_fresh_draws", "ci_low", "ci_high",
                 "size_mm"});
  for (std::size_t rank = 0; rank < worst.size(); ++rank) {
    const std::int64_t i = worst[rank];
    const std::string name = fmt::format("adversarial_{:02d}.stl", rank + 1);
    WriteMesh(folder.Stl() / name,
              FitToPlate(*mesh(static_cast<std::int64_t>(rank)), config.stl_size_mm));
    csv.Text(name)
        .Text(SampleName(i))
        .Number(value(i))
        .NumbersOrGaps({again[rank].value, again[rank].ci_low, again[rank].ci_high})
        .Number(config.stl_size_mm);
    csv.EndRow();
  }
  WriteFileAtomic(folder.Stl() / "scores.csv", csv.text());
}

}  // namespace antigrasp
