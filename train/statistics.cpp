#include "antigrasp/train/statistics.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <sstream>

#include "antigrasp/core/csv_writer.h"

namespace antigrasp {
namespace {

std::string Printf(const char* format, double value) {
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, format, value);
  return buffer;
}

std::string RejectedText(const StageStatistics& row) {
  std::string reasons;
  for (int i = 1; i < kNumRemeshStatuses; ++i) {
    const int count = row.by_status[static_cast<std::size_t>(i)];
    if (count == 0) continue;
    reasons += (reasons.empty() ? "" : ", ") + std::to_string(count) + " " +
               std::string(Name(static_cast<RemeshStatus>(i)));
  }
  return reasons.empty() ? "0" : reasons;
}

// A row of a run or of its control with what its kappa is measured against; a control's rows are
// measured against those of the run. None: there is no such reference, or it is 0.
struct ComparedStage {
  const StageStatistics* row;
  bool control;
  std::optional<MeanInterval> by_prior, by_first, by_control;
};

std::vector<ComparedStage> Compare(const std::vector<StageStatistics>& rows,
                                   const std::vector<StageStatistics>& control) {
  const StageStatistics* prior = FindStage(rows, -1);
  const StageStatistics* first = FindStage(rows, 0);
  std::vector<ComparedStage> stages;
  const auto add = [&](const StageStatistics& row, bool is_control, const StageStatistics* same) {
    const auto ratio = [&](const StageStatistics* reference) -> std::optional<MeanInterval> {
      if (reference == nullptr || !(reference->graspability.mean > 0)) return std::nullopt;
      return Ratio(row.graspability, reference->graspability);
    };
    stages.push_back(
        {&row, is_control, ratio(prior), ratio(row.stage < 0 ? nullptr : first), ratio(same)});
  };
  for (const StageStatistics& row : rows) {
    add(row, false, row.stage > 0 ? FindStage(control, row.stage) : nullptr);
  }
  for (const StageStatistics& row : control) {
    if (row.stage > 0) add(row, true, nullptr);
  }
  return stages;
}

std::string RatioText(const std::optional<MeanInterval>& ratio) {
  return ratio ? MeanText(*ratio, 2) : "-";
}

std::string Share(double value) { return std::isnan(value) ? "-" : Printf("%.0f %%", 100 * value); }

// Columns padded to their widest cell, two spaces between.
std::string Aligned(const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> widths(rows.front().size());
  for (const auto& row : rows) {
    for (std::size_t c = 0; c < row.size(); ++c) widths[c] = std::max(widths[c], row[c].size());
  }
  std::ostringstream out;
  for (const auto& row : rows) {
    std::string line;
    for (std::size_t c = 0; c < row.size(); ++c) {
      line += row[c] + std::string(widths[c] - row[c].size() + 2, ' ');
    }
    out << line.substr(0, line.find_last_not_of(' ') + 1) << "\n";
  }
  return out.str();
}

}  // namespace

const StageStatistics* FindStage(const std::vector<StageStatistics>& rows, int stage) {
  for (const StageStatistics& row : rows) {
    if (row.stage == stage) return &row;
  }
  return nullptr;
}

MeanInterval Ratio(const MeanInterval& value, const MeanInterval& reference) {
  MeanInterval ratio{.mean = value.mean / reference.mean, .half_width = 0, .count = value.count};
  const double own = value.half_width / reference.mean;
  const double theirs = ratio.mean * reference.half_width / reference.mean;
  ratio.half_width = std::hypot(own, theirs);
  return ratio;
}

std::string KappaCsv(const std::vector<StageStatistics>& rows,
                     const std::vector<StageStatistics>& control) {
  CsvWriter csv({"control", "stage", "graspability", "graspability_half_width_95", "kappa_prior",
                 "kappa_prior_half_width_95", "kappa_episode_0", "kappa_episode_0_half_width_95",
                 "kappa_control", "kappa_control_half_width_95"});
  for (const ComparedStage& stage : Compare(rows, control)) {
    csv.Count(stage.control ? 1 : 0).Text(std::to_string(stage.row->stage));
    for (const std::optional<MeanInterval>& value :
         {std::optional(stage.row->graspability), stage.by_prior, stage.by_first,
          stage.by_control}) {
      csv.NumbersOrGaps(
          {value ? value->mean : std::nan(""), value ? value->half_width : std::nan("")});
    }
    csv.EndRow();
  }
  return csv.text();
}

std::string StatisticsTable(const std::vector<StageStatistics>& rows,
                            const std::vector<StageStatistics>& control) {
  std::vector<std::vector<std::string>> cells = {{"episode", "samples", "rejected", "graspability",
                                                  "/ prior", "/ episode 0", "/ control", "coverage",
                                                  "near-duplicates", "flat edges"}};
  for (const ComparedStage& stage : Compare(rows, control)) {
    const StageStatistics& row = *stage.row;
    const std::string episode = row.stage < 0 ? "prior set" : std::to_string(row.stage);
    cells.push_back({(stage.control ? "control " : "") + episode, std::to_string(row.samples),
                     RejectedText(row), MeanText(row.graspability, 5), RatioText(stage.by_prior),
                     RatioText(stage.by_first), RatioText(stage.by_control), Share(row.coverage),
                     Share(row.duplicates), Share(row.flat)});
  }
  return Aligned(cells);
}

}  // namespace antigrasp
