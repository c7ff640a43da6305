#include "antigrasp/perturb/perturb_summary.h"

#include <cstdio>
#include <map>
#include <utility>

#include "antigrasp/core/csv_writer.h"
#include "antigrasp/perturb/scored_perturbation.h"

namespace antigrasp {
namespace {

// The first word or two of a status: "after: open: 3 boundary edges" counts as "after: open".
std::string Reason(const std::string& status) {
  const std::size_t first = status.find(": ");
  if (first == std::string::npos) return status;
  const std::string stage = status.substr(0, first);
  if (stage != "before" && stage != "after" && stage != "decimated") return stage;
  return status.substr(0, status.find(": ", first + 2));
}

}  // namespace

std::vector<PerturbRow> PairsOf(const std::vector<ScoreRow>& scores) {
  std::vector<PerturbRow> rows;
  for (const ScoreRow& score : scores) {
    PerturbRow row{.object = score.object, .status = score.score ? "ok" : score.status};
    if (score.score) row.graspability_after = score.score->graspability;
    for (const auto& [name, value] : score.extras) {
      if (name == "baseline") row.graspability_before = value;
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

PerturbMeans MeansOf(const std::vector<PerturbRow>& rows) {
  std::vector<double> before, after, turn, hausdorff, volume, judged_before, judged_after, change;
  std::string judge;
  for (const PerturbRow& row : rows) {
    if (row.status != "ok") continue;
    before.push_back(row.graspability_before);
    after.push_back(row.graspability_after);
    turn.push_back(row.normal_max_deg);
    hausdorff.push_back(row.hausdorff_pct);
    volume.push_back(std::abs(row.volume_change_pct));
    if (row.judge.empty()) continue;
    judge = row.judge;
    if (std::isnan(row.judge_before) || std::isnan(row.judge_after)) continue;
    judged_before.push_back(row.judge_before);
    judged_after.push_back(row.judge_after);
    change.push_back(row.judge_after - row.judge_before);
  }
  const auto mean = [](const std::vector<double>& values) { return MeanWithInterval(values).mean; };
  return {.objects = static_cast<int>(rows.size()),
          .ok = static_cast<int>(before.size()),
          .graspability_before = mean(before),
          .graspability_after = mean(after),
          .reduction = KappaReduction(before, after),
          .normal_max_deg = mean(turn),
          .hausdorff_pct = mean(hausdorff),
          .volume_pct = mean(volume),
          .judge = judge,
          .judge_before = mean(judged_before),
          .judge_after = mean(judged_after),
          .judge_difference = MeanWithInterval(change)};
}

std::string PerturbMeansCsv(const PerturbMeans& means) {
  std::vector<std::string> names = {"objects",
                                    "ok",
                                    "graspability_before",
                                    "graspability_after",
                                    "reduction_pct",
                                    "reduction_half_width_95",
                                    "normal_max_deg",
                                    "hausdorff_pct",
                                    "volume_pct"};
  const bool judged = !means.judge.empty();
  if (judged) {
    names.insert(names.end(), {"judge", "judge_before", "judge_after", "judge_difference",
                               "judge_difference_half_width_95"});
  }
  CsvWriter csv(names);
  csv.Count(means.objects).Count(means.ok);
  csv.NumbersOrGaps({means.graspability_before, means.graspability_after, means.reduction.mean,
                     means.reduction.half_width, means.normal_max_deg, means.hausdorff_pct,
                     means.volume_pct});
  if (judged) {
    csv.Text(means.judge)
        .NumbersOrGaps({means.judge_before, means.judge_after, means.judge_difference.mean,
                        means.judge_difference.half_width});
  }
  csv.EndRow();
  return csv.text();
}

namespace {

// "\njudge trial:six-ways, 12 objects: 0.7432 -> 0.4123, difference -0.3309 +-0.0612"; "" without.
std::string JudgeMeansText(const PerturbMeans& means) {
  if (means.judge.empty()) return "";
  const std::string who = "\njudge " + means.judge + ", ";
  const MeanInterval& difference = means.judge_difference;
  if (difference.count == 0) return who + "no object scored before and after";
  char text[160], interval[32] = "";
  if (std::isfinite(difference.half_width)) {
    std::snprintf(interval, sizeof interval, " +-%.4f", difference.half_width);
  }
  std::snprintf(text, sizeof text, "%d of %d objects: %.4f -> %.4f, difference %+.4f%s",
                static_cast<int>(difference.count), means.ok, means.judge_before, means.judge_after,
                difference.mean, interval);
  return who + text;
}

}  // namespace

std::string PerturbMeansText(const PerturbMeans& means) {
  if (means.ok == 0) return "no object perturbed";
  char interval[64] = "", text[320];
  if (std::isfinite(means.reduction.half_width)) {  // a single object says nothing about the spread
    std::snprintf(interval, sizeof interval, " +-%.1f", means.reduction.half_width);
  }
  char reduced[96] = "no kappa to reduce";
  if (std::isfinite(means.reduction.mean)) {
    std::snprintf(reduced, sizeof reduced, "kappa reduced by %.1f%s %%", means.reduction.mean,
                  interval);
  }
  std::snprintf(text, sizeof text,
                "%d of %d objects perturbed: mean graspability %.5f -> %.5f, %s\n"
                "mean over objects: largest turn of a normal %.1f degrees, Hausdorff distance %.2f "
                "%% of the diagonal",
                means.ok, means.objects, means.graspability_before, means.graspability_after,
                reduced, means.normal_max_deg, means.hausdorff_pct);
  return text + JudgeMeansText(means);
}

std::string ScoreMeansText(const PerturbMeans& means) {
  char text[200];
  std::snprintf(text, sizeof text, "scores, %d of %d objects scored\n  graspability  %.5f\n",
                means.ok, means.objects, means.graspability_after);
  std::string lines = text;
  if (means.reduction.count == 0) return lines;
  std::snprintf(text, sizeof text, "  originals     %.5f\n  reduction     %.1f +-%.1f %%\n",
                means.graspability_before, means.reduction.mean, means.reduction.half_width);
  return lines + text;
}

std::string FailedText(const std::vector<PerturbRow>& rows) {
  std::map<std::string, int> failed;
  for (const PerturbRow& row : rows) {
    if (row.status != "ok") ++failed[Reason(row.status)];
  }
  std::string reasons;
  for (const auto& [reason, count] : failed) {
    reasons += (reasons.empty() ? "" : ", ") + std::to_string(count) + " " + reason;
  }
  return reasons;
}

}  // namespace antigrasp
