#include "antigrasp/train/statistics.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <sstream>

#include "antigrasp/core/error.h"
#include "antigrasp/core/format.h"

namespace antigrasp {
namespace {

constexpr int kNumColumns = 12 + kNumRemeshStatuses;

std::string Header() {
  std::string header = "stage,samples";
  for (int i = 0; i < kNumRemeshStatuses; ++i) {
    header += "," + std::string(Name(static_cast<RemeshStatus>(i)));
  }
  return header +
         ",scored,without_grasps,graspability,half_width_95,count,elite_threshold,coverage,nna,"
         "duplicates,diversity";
}

std::vector<double> Values(const StageStatistics& row) {
  std::vector<double> values = {double(row.stage), double(row.samples)};
  for (const int count : row.by_status) values.push_back(count);
  for (const double value :
       {double(row.scored), double(row.without_grasps), row.graspability.mean,
        row.graspability.half_width, double(row.graspability.count), row.elite_threshold,
        row.coverage, row.nna, row.duplicates, row.diversity}) {
    values.push_back(value);
  }
  return values;
}

StageStatistics FromValues(const std::vector<double>& values) {
  std::size_t next = 0;
  const auto take = [&] { return values[next++]; };
  const auto take_int = [&] { return static_cast<int>(values[next++]); };
  StageStatistics row;
  row.stage = take_int();
  row.samples = take_int();
  for (int& count : row.by_status) count = take_int();
  row.scored = take_int();
  row.without_grasps = take_int();
  row.graspability.mean = take();
  row.graspability.half_width = take();
  row.graspability.count = take_int();
  row.elite_threshold = take();
  row.coverage = take();
  row.nna = take();
  row.duplicates = take();
  row.diversity = take();
  return row;
}

std::string Printf(const char* format, double a, double b = 0) {
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, format, a, b);
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

std::string RatioText(const MeanInterval& value, const MeanInterval* reference) {
  if (reference == nullptr || !(reference->mean > 0)) return "-";
  const MeanInterval ratio = Ratio(value, *reference);
  return Printf("%.2f +-%.2f", ratio.mean, ratio.half_width);
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

std::string StatisticsToCsv(const std::vector<StageStatistics>& rows) {
  std::string csv = Header() + "\n";
  for (const StageStatistics& row : rows) {
    std::string line;
    for (const double value : Values(row)) line += (line.empty() ? "" : ",") + FormatDouble(value);
    csv += line + "\n";
  }
  return csv;
}

std::vector<StageStatistics> StatisticsFromCsv(const std::string& csv, const std::string& origin) {
  std::istringstream lines(csv);
  std::string line;
  std::getline(lines, line);
  if (line != Header()) throw InputError("not a statistics table", origin, Header());
  std::vector<StageStatistics> rows;
  for (int number = 2; std::getline(lines, line); ++number) {
    std::vector<double> values;
    std::istringstream fields(line);
    for (std::string field; std::getline(fields, field, ',');) {
      double value = std::nan("");
      const auto parsed = std::from_chars(field.data(), field.data() + field.size(), value);
      if (parsed.ec != std::errc()) break;
      values.push_back(value);
    }
    if (values.size() != kNumColumns) {
      throw InputError("a row of " + std::to_string(values.size()) + " numbers",
                       origin + ":" + std::to_string(number),
                       std::to_string(kNumColumns) + " numbers");
    }
    rows.push_back(FromValues(values));
  }
  return rows;
}

std::string StatisticsTable(const std::vector<StageStatistics>& rows,
                            const std::vector<StageStatistics>& control) {
  std::vector<std::vector<std::string>> cells = {{"episode", "samples", "rejected", "graspability",
                                                  "/ prior", "/ episode 0", "/ control", "coverage",
                                                  "near-duplicates"}};
  const StageStatistics* prior = FindStage(rows, -1);
  const StageStatistics* first = FindStage(rows, 0);
  const auto add = [&](const std::string& label, const StageStatistics& row, bool compare) {
    const StageStatistics* same = compare ? FindStage(control, row.stage) : nullptr;
    cells.push_back(
        {label, std::to_string(row.samples), RejectedText(row),
         Printf("%.5f +-%.5f", row.graspability.mean, row.graspability.half_width),
         RatioText(row.graspability, prior ? &prior->graspability : nullptr),
         row.stage < 0 ? "-" : RatioText(row.graspability, first ? &first->graspability : nullptr),
         RatioText(row.graspability, same ? &same->graspability : nullptr), Share(row.coverage),
         Share(row.duplicates)});
  };
  for (const StageStatistics& row : rows) {
    add(row.stage < 0 ? "prior set" : std::to_string(row.stage), row, row.stage > 0);
  }
  for (const StageStatistics& row : control) {
    if (row.stage > 0) add("control " + std::to_string(row.stage), row, false);
  }
  return Aligned(cells);
}

}  // namespace antigrasp
