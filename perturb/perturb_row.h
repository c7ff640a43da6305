#pragma once

#include <string>
#include <vector>

#include "antigrasp/perturb/perturb_table.h"
#include "antigrasp/perturb/scored_perturbation.h"

namespace antigrasp {

// The row of perturb.csv, all but faces_before. `measured`: whether there are scores and distances;
// not of an object that was refused or cut short.
PerturbRow RowOf(const std::string& object, const std::string& status,
                 const ScoredPerturbation& scored, bool measured);

// |F_a| on the way: iteration, pairs, pairs below the cone (IV-A).
PerturbHistory HistoryOf(const std::string& object, const std::vector<PairCount>& counts);

}  // namespace antigrasp
