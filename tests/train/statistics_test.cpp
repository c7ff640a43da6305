#include "antigrasp/train/statistics.h"

#include <gtest/gtest.h>

#include <cmath>

#include "antigrasp/core/error.h"

namespace antigrasp {
namespace {

StageStatistics Row(int stage, double mean, double half_width) {
  StageStatistics row;
  row.stage = stage;
  row.samples = 100;
  row.by_status = {97, 0, 1, 0, 0, 0, 0, 0, 2};
  row.scored = 97;
  row.graspability = {mean, half_width, 97};
  row.elite_threshold = std::nan("");
  row.coverage = 1.0 / 3;
  return row;
}

TEST(Ratio, PropagatesBothIntervals) {
  const MeanInterval ratio = Ratio({2.0, 0.3, 10}, {4.0, 0.8, 20});
  EXPECT_DOUBLE_EQ(ratio.mean, 0.5);
  EXPECT_NEAR(ratio.half_width, std::hypot(0.3 / 4, 0.5 * 0.8 / 4), 1e-15);
}

TEST(Statistics, SurviveARoundTripThroughCsv) {
  const std::vector<StageStatistics> rows = {Row(-1, 0.004, 1e-4), Row(0, 1.0 / 7, 0.1)};
  const std::string csv = StatisticsToCsv(rows);
  EXPECT_EQ(StatisticsToCsv(StatisticsFromCsv(csv, "x")), csv);
  EXPECT_EQ(StatisticsFromCsv(csv, "x")[1].graspability.mean, 1.0 / 7);
  EXPECT_TRUE(std::isnan(StatisticsFromCsv(csv, "x")[0].elite_threshold));
}

TEST(Statistics, RefuseAForeignOrBrokenTable) {
  EXPECT_THROW(StatisticsFromCsv("a,b\n1,2\n", "x"), InputError);
  const std::string csv = StatisticsToCsv({Row(0, 1, 1)});
  EXPECT_THROW(StatisticsFromCsv(csv.substr(0, csv.size() - 8), "x"), InputError);
}

TEST(StatisticsTable, ShowsReductionsAgainstPriorEpisodeZeroAndControl) {
  const std::string table =
      StatisticsTable({Row(-1, 0.004, 0), Row(0, 0.005, 0), Row(1, 0.002, 0)},
                      {Row(-1, 0.004, 0), Row(0, 0.005, 0), Row(1, 0.0025, 0)});
  EXPECT_NE(table.find("0.50 +-0.00  0.40 +-0.00  0.80 +-0.00"), std::string::npos) << table;
  EXPECT_NE(table.find("1 empty, 2 disjoint"), std::string::npos) << table;
  EXPECT_NE(table.find("control 1"), std::string::npos) << table;
}

}  // namespace
}  // namespace antigrasp
