#pragma once

#include <array>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

namespace antigrasp {

// A row of perturb.csv (docs/formats.md). Every number may be missing: NaN, an empty field.
struct PerturbRow {
  std::string object, status;
  double faces_before = std::nan(""), faces_after = std::nan("");
  double pairs_before = std::nan(""), pairs_after = std::nan("");
  double graspability_before = std::nan(""), graspability_after = std::nan("");
  double difference = std::nan("");
  double normal_max_deg = std::nan(""), normal_mean_deg = std::nan("");
  double hausdorff_pct = std::nan(""), chamfer_pct = std::nan("");
  double volume_change_pct = std::nan(""), center_of_mass_pct = std::nan("");
  double iterations = std::nan(""), moved = std::nan("");
  double no_gain = std::nan(""), refused = std::nan("");
  std::string judge = {};  // of a search on a judge
  double judge_before = std::nan(""), judge_after = std::nan("");
};

// The columns behind object and status, in the order of the file.
struct PerturbColumn {
  const char* name;
  double PerturbRow::*value;
  bool count;  // a whole number
};
inline constexpr std::array<PerturbColumn, 17> kPerturbColumns = {{
    {"faces_before", &PerturbRow::faces_before, true},
    {"faces_after", &PerturbRow::faces_after, true},
    {"pairs_before", &PerturbRow::pairs_before, true},
    {"pairs_after", &PerturbRow::pairs_after, true},
    {"graspability_before", &PerturbRow::graspability_before, false},
    {"graspability_after", &PerturbRow::graspability_after, false},
    {"difference", &PerturbRow::difference, false},
    {"normal_max_deg", &PerturbRow::normal_max_deg, false},
    {"normal_mean_deg", &PerturbRow::normal_mean_deg, false},
    {"hausdorff_pct", &PerturbRow::hausdorff_pct, false},
    {"chamfer_pct", &PerturbRow::chamfer_pct, false},
    {"volume_change_pct", &PerturbRow::volume_change_pct, false},
    {"center_of_mass_pct", &PerturbRow::center_of_mass_pct, false},
    {"iterations", &PerturbRow::iterations, true},
    {"moved", &PerturbRow::moved, true},
    {"no_gain", &PerturbRow::no_gain, true},
    {"refused", &PerturbRow::refused, true},
}};

// With the columns judge, judge_before and judge_after when a row has a judge.
std::string PerturbCsv(const std::vector<PerturbRow>& rows);

// InputError with file:line for a damaged table or one without object, status and both
// graspabilities; other columns are read where they are there.
std::vector<PerturbRow> ReadPerturbTable(const std::filesystem::path& path);

// |F_a| of one object on the way (IV-A): its rows of history.csv. NaN is a gap.
struct PerturbHistory {
  std::string object;
  std::vector<double> iteration, pairs, pairs_below_cone;
};

std::string PerturbHistoryCsv(const std::vector<PerturbHistory>& histories);

// One history an object, in the file's order. InputError for a table without rows or columns.
std::vector<PerturbHistory> ReadPerturbHistory(const std::filesystem::path& path);

}  // namespace antigrasp
