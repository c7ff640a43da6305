#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "antigrasp/core/statistics.h"
#include "antigrasp/perturb/perturb_table.h"
#include "antigrasp/quality/score_table.h"

namespace antigrasp {

// What perturb.csv says as a whole, of the objects with status "ok". NaN: there is no such number.
struct PerturbMeans {
  int objects = 0, ok = 0;
  double graspability_before = std::nan(""), graspability_after = std::nan("");  // means
  MeanInterval reduction;                // KappaReduction, percent
  double normal_max_deg = std::nan("");  // means over objects: of an object's largest turn,
  double hausdorff_pct = std::nan("");   // of its distance, percent of the diagonal,
  double volume_pct = std::nan("");      // of the size of its change of volume, percent
  std::string judge;                     // of a search on a judge: means over what it scored twice
  double judge_before = std::nan(""), judge_after = std::nan("");
  MeanInterval judge_difference;  // after - before, paired
};

// A table of scores as one of objects before and after: with originals (evaluate --baseline) it is.
std::vector<PerturbRow> PairsOf(const std::vector<ScoreRow>& scores);

PerturbMeans MeansOf(const std::vector<PerturbRow>& rows);

// summary.csv (docs/formats.md): one row.
std::string PerturbMeansCsv(const PerturbMeans& means);

// The same as two sentences without a full stop, a line break between; for a person.
std::string PerturbMeansText(const PerturbMeans& means);

// The same of PairsOf: two or four lines.
std::string ScoreMeansText(const PerturbMeans& means);

// The failed objects by reason, "1 after: open, 2 interrupted"; empty when none failed.
std::string FailedText(const std::vector<PerturbRow>& rows);

}  // namespace antigrasp
