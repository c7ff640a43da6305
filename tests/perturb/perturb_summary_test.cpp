#include "antigrasp/perturb/perturb_summary.h"

#include <gtest/gtest.h>

namespace antigrasp {
namespace {

PerturbRow RowOf(const std::string& status, double before, double after) {
  PerturbRow row{.object = "o", .status = status};
  row.graspability_before = before;
  row.graspability_after = after;
  return row;
}

// Means 2 and 1.5, a quarter less. Residuals (0.75 - 0.75) / 2 and (2.25 - 2.25) / 2: every object
// falls by the same share, so there is no doubt about it.
std::vector<PerturbRow> TwoOfFour() {
  std::vector<PerturbRow> rows = {RowOf("ok", 1.0, 0.75), RowOf("after: open: 3 edges", 9.0, 8.0),
                                  RowOf("ok", 3.0, 2.25), RowOf("interrupted", 7.0, 0.0)};
  for (PerturbRow& row : rows) row.normal_max_deg = row.hausdorff_pct = 99.0;
  rows[0].normal_max_deg = 10.0;
  rows[2].normal_max_deg = std::nan("");
  rows[0].hausdorff_pct = 0.5;
  rows[2].hausdorff_pct = 1.0;
  rows[0].volume_change_pct = -3.0;
  rows[2].volume_change_pct = 4.0;
  return rows;
}

TEST(PerturbMeans, AreOfTheObjectsThatWorkedAndOfTheSizeOfAChangeOfVolume) {
  EXPECT_EQ(PerturbMeansCsv(MeansOf(TwoOfFour())),
            "objects,ok,graspability_before,graspability_after,reduction_pct,"
            "reduction_half_width_95,normal_max_deg,hausdorff_pct,volume_pct\n"
            "4,2,2,1.5,25,0,10,0.75,3.5\n");
}

TEST(PerturbMeans, OfNothingAreGaps) {
  const std::string csv = PerturbMeansCsv(MeansOf({RowOf("interrupted", 1.0, 1.0)}));
  EXPECT_EQ(csv.substr(csv.find('\n') + 1), "1,0,,,,,,,\n");
  EXPECT_EQ(PerturbMeansText(MeansOf({})), "no object perturbed");
}

TEST(PerturbMeans, HaveNoIntervalOfOneObject) {
  const PerturbMeans means = MeansOf({RowOf("ok", 2.0, 0.5)});
  EXPECT_EQ(means.reduction.mean, 75.0);
  EXPECT_TRUE(std::isnan(means.reduction.half_width));
  EXPECT_NE(PerturbMeansText(means).find("kappa reduced by 75.0 %"), std::string::npos);
}

TEST(PerturbMeans, OfObjectsThatScoredNothingHaveNoReduction) {
  const std::string text = PerturbMeansText(MeansOf({RowOf("ok", 0.0, 0.0)}));
  EXPECT_NE(text.find("graspability 0.00000 -> 0.00000, no kappa to reduce\n"), std::string::npos)
      << text;
}

TEST(FailedText, CountsObjectsByTheFirstWordsOfTheirStatus) {
  std::vector<PerturbRow> rows = TwoOfFour();
  rows.push_back(RowOf("after: open: 5 edges", 1.0, 1.0));
  EXPECT_EQ(FailedText(rows), "2 after: open, 1 interrupted");
  EXPECT_EQ(FailedText({RowOf("ok", 1.0, 1.0)}), "");
}

}  // namespace
}  // namespace antigrasp
