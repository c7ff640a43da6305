#include "antigrasp/perturb/perturb_row.h"

#include <cmath>
#include <numeric>

namespace antigrasp {
namespace {

double CountOrGap(std::int64_t n) { return n < 0 ? std::nan("") : static_cast<double>(n); }

}  // namespace

PerturbRow RowOf(const std::string& object, const std::string& status,
                 const ScoredPerturbation& scored, bool measured) {
  PerturbRow row{object, status};
  row.faces_after = static_cast<double>(scored.result.mesh.faces.size());
  row.pairs_before = CountOrGap(scored.pairs_before);
  row.pairs_after = CountOrGap(scored.pairs_after);
  if (measured) {
    row.graspability_before = scored.graspability_before;
    row.graspability_after = scored.graspability_after;
    row.difference = scored.graspability_after - scored.graspability_before;
    row.normal_max_deg = scored.normals.largest;
    row.normal_mean_deg = scored.normals.mean;
    row.hausdorff_pct = scored.change.hausdorff;
    row.chamfer_pct = scored.change.chamfer;
    row.volume_change_pct = scored.change.volume_change;
    row.center_of_mass_pct = scored.change.center_of_mass;
  }
  row.judge = scored.judge;
  row.judge_before = scored.judge_before;
  row.judge_after = scored.judge_after;
  const auto& refused = scored.result.refused;
  row.iterations = CountOrGap(scored.result.iterations);
  row.moved = CountOrGap(scored.result.moved);
  row.no_gain = CountOrGap(scored.result.no_gain);
  row.refused = CountOrGap(std::accumulate(refused.begin(), refused.end(), std::int64_t{0}));
  return row;
}

PerturbHistory HistoryOf(const std::string& object, const std::vector<PairCount>& counts) {
  PerturbHistory history{object, {}, {}, {}};
  for (const PairCount& count : counts) {
    history.iteration.push_back(static_cast<double>(count.iteration));
    history.pairs.push_back(static_cast<double>(count.pairs));
    history.pairs_below_cone.push_back(CountOrGap(count.below));
  }
  return history;
}

}  // namespace antigrasp
