#include "antigrasp/train/statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <sstream>

#include "antigrasp/core/error.h"
#include "antigrasp/train/statistics_table.h"

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
  EXPECT_EQ(ratio.count, 10);
}

TEST(FindStage, FindsARowByItsStageAndNotByItsPlace) {
  const std::vector<StageStatistics> rows = {Row(1, 0.1, 0), Row(-1, 0.2, 0), Row(0, 0.3, 0)};
  EXPECT_EQ(FindStage(rows, -1), &rows[1]);
  EXPECT_EQ(FindStage(rows, 0), &rows[2]);
  EXPECT_EQ(FindStage(rows, 2), nullptr);
}

// Every field has a value of its own, so that none can stand in the column of another.
constexpr const char* kTableOfOwnValues =
    "stage,samples,ok,non_finite,empty,touches_border,gaps,non_manifold,non_orientable,"
    "self_intersecting,disjoint,scored,without_grasps,graspability,half_width_95,count,"
    "elite_threshold,coverage,nna,duplicates,diversity,flat_share,crease_share\n"
    "3,50,12,13,14,15,16,17,18,19,20,21,22,0.5,0.25,23,0.75,0.125,0.375,0.625,0.875,0.0625,"
    "0.03125\n";

TEST(Statistics, WriteEveryFieldUnderItsOwnName) {
  StageStatistics row;
  row.stage = 3;
  row.samples = 50;
  row.by_status = {12, 13, 14, 15, 16, 17, 18, 19, 20};
  row.scored = 21;
  row.without_grasps = 22;
  row.graspability = {.mean = 0.5, .half_width = 0.25, .count = 23};
  row.elite_threshold = 0.75;
  row.coverage = 0.125;
  row.nna = 0.375;
  row.duplicates = 0.625;
  row.diversity = 0.875;
  row.flat = 0.0625;
  row.crease = 0.03125;
  EXPECT_EQ(StatisticsToCsv({row}), kTableOfOwnValues);
  EXPECT_EQ(row.rejected(), 38);  // 50 without the 12 that are ok
}

TEST(Statistics, ReadEveryFieldFromTheColumnOfItsName) {
  const auto rows = StatisticsFromCsv(kTableOfOwnValues, "x");
  ASSERT_EQ(rows.size(), 1U);
  const StageStatistics& row = rows[0];
  EXPECT_EQ(row.stage, 3);
  EXPECT_EQ(row.samples, 50);
  for (int i = 0; i < kNumRemeshStatuses; ++i) {
    EXPECT_EQ(row.by_status[static_cast<std::size_t>(i)], 12 + i);
  }
  EXPECT_EQ(row.by_status[static_cast<std::size_t>(RemeshStatus::kDisjoint)], 20);
  EXPECT_EQ(row.scored, 21);
  EXPECT_EQ(row.without_grasps, 22);
  EXPECT_EQ(row.graspability.mean, 0.5);
  EXPECT_EQ(row.graspability.half_width, 0.25);
  EXPECT_EQ(row.graspability.count, 23);
  EXPECT_EQ(row.elite_threshold, 0.75);
  EXPECT_EQ(row.coverage, 0.125);
  EXPECT_EQ(row.nna, 0.375);
  EXPECT_EQ(row.duplicates, 0.625);
  EXPECT_EQ(row.diversity, 0.875);
  EXPECT_EQ(row.flat, 0.0625);
  EXPECT_EQ(row.crease, 0.03125);
}

TEST(Statistics, OfAnEarlierVersionHaveNoSharesOfEdges) {
  const std::string table =
      "stage,samples,ok,non_finite,empty,touches_border,gaps,non_manifold,non_orientable,"
      "self_intersecting,disjoint,scored,without_grasps,graspability,half_width_95,count,"
      "elite_threshold,coverage,nna,duplicates,diversity\n"
      "0,9,9,0,0,0,0,0,0,0,0,9,0,0.5,0.25,9,0.75,0.125,0.375,0.625,0.875\n";
  auto rows = StatisticsFromCsv(table, "x");
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0].diversity, 0.875);
  EXPECT_TRUE(std::isnan(rows[0].flat) && std::isnan(rows[0].crease));
  // A run that goes on writes both of what it makes, in the columns of this version.
  rows.push_back(Row(1, 1, 1));
  rows[1].flat = 0.5;
  const std::string csv = StatisticsToCsv(rows);
  EXPECT_NE(csv.find(",diversity,flat_share,crease_share\n"), std::string::npos) << csv;
  EXPECT_NE(csv.find(",0.875,nan,nan\n"), std::string::npos) << csv;
  EXPECT_EQ(StatisticsFromCsv(csv, "x")[1].flat, 0.5);
  // One of the two alone is nobody's table.
  EXPECT_THROW(StatisticsFromCsv(csv.substr(0, csv.find(",crease_share")) + "\n", "x"), InputError);
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

using Cells = std::map<std::string, std::string>;  // of a line, by the names in the first line

// A cell begins where the name of its column does.
std::vector<Cells> Parsed(const std::string& table, const std::vector<std::string>& names) {
  std::istringstream lines(table);
  std::string header;
  std::getline(lines, header);
  std::vector<std::size_t> starts;
  for (const std::string& name : names) {
    starts.push_back(header.find(name, starts.empty() ? 0 : starts.back() + 1));
  }
  std::vector<Cells> rows;
  for (std::string line; std::getline(lines, line);) {
    line.resize(std::max(line.size(), header.size() + 1), ' ');
    Cells cells;
    for (std::size_t c = 0; c < names.size(); ++c) {
      const std::size_t end = c + 1 < names.size() ? starts[c + 1] : line.size();
      const std::string cell = line.substr(starts[c], end - starts[c]);
      cells[names[c]] = cell.substr(0, cell.find_last_not_of(' ') + 1);
    }
    rows.push_back(cells);
  }
  return rows;
}

const std::vector<std::string> kColumns = {
    "episode",     "samples",   "rejected", "graspability",    "/ prior",
    "/ episode 0", "/ control", "coverage", "near-duplicates", "flat edges"};

TEST(StatisticsTable, DividesByPriorEpisodeZeroAndTheControlOfTheSameEpisode) {
  StageStatistics prior = Row(-1, 0.004, 0.0004);
  prior.coverage = prior.duplicates = std::nan("");
  StageStatistics last = Row(2, 0.001, 0.0);
  last.coverage = 0.25;
  last.duplicates = 0.13;
  last.flat = 0.62;
  // The control's prior set and episode 0 are other ones here: they must not be divided by.
  const std::string table =
      StatisticsTable({prior, Row(0, 0.005, 0.001), Row(1, 0.002, 0.0002), last},
                      {Row(-1, 1.0, 0), Row(0, 2.0, 0), Row(1, 0.0025, 0), Row(2, 0.004, 0)});
  auto rows = Parsed(table, kColumns);
  ASSERT_EQ(rows.size(), 6U) << table;
  const auto expect = [&](std::size_t row, const std::vector<std::string>& cells) {
    for (std::size_t c = 0; c < cells.size(); ++c) {
      EXPECT_EQ(rows[row][kColumns[c]], cells[c]) << kColumns[c] << "\n" << table;
    }
  };
  const std::string rejected = "1 empty, 2 disjoint", graspability = "0.00400 +-0.00040";
  // 1 +- hypot(0.1, 0.1)
  expect(0, {"prior set", "100", rejected, graspability, "1.00 +-0.14", "-", "-", "-", "-", "-"});
  // 1.25 +- hypot(0.25, 1.25 x 0.1); 1 +- hypot(0.2, 0.2)
  expect(1, {"0", "100", rejected, "0.00500 +-0.00100", "1.25 +-0.28", "1.00 +-0.28", "-", "33 %",
             "0 %", "-"});
  // 0.5 +- hypot(0.05, 0.5 x 0.1); 0.4 +- hypot(0.04, 0.4 x 0.2); 0.8 +- 0.08
  expect(2, {"1", "100", rejected, "0.00200 +-0.00020", "0.50 +-0.07", "0.40 +-0.09", "0.80 +-0.08",
             "33 %", "0 %", "-"});
  expect(3, {"2", "100", rejected, "0.00100 +-0.00000", "0.25 +-0.03", "0.20 +-0.04", "0.25 +-0.00",
             "25 %", "13 %", "62 %"});
  expect(4, {"control 1", "100", rejected, "0.00250 +-0.00000", "0.62 +-0.06", "0.50 +-0.10", "-",
             "33 %", "0 %", "-"});
  expect(5, {"control 2", "100", rejected, "0.00400 +-0.00000", "1.00 +-0.10", "0.80 +-0.16", "-",
             "33 %", "0 %", "-"});
}

// Powers of two, so that every number is exact: 0.25 by 1, 0.5 and (of the same episode) 2; the
// half width of the prior's mean is a quarter of it, that of the control's an eighth.
TEST(KappaCsv, HasEveryRatioWithItsHalfWidthUnderItsNameAndGapsWithoutAReference) {
  const std::string csv = KappaCsv({Row(-1, 1.0, 0.25), Row(0, 0.5, 0), Row(2, 0.25, 0)},
                                   {Row(-1, 7.0, 0), Row(0, 9.0, 0), Row(2, 2.0, 0.25)});
  EXPECT_EQ(csv,
            "control,stage,graspability,graspability_half_width_95,kappa_prior,"
            "kappa_prior_half_width_95,kappa_episode_0,kappa_episode_0_half_width_95,"
            "kappa_control,kappa_control_half_width_95\n"
            "0,-1,1,0.25,1,0.3535533905932738,,,,\n"  // hypot(0.25, 0.25)
            "0,0,0.5,0,0.5,0.125,1,0,,\n"
            "0,2,0.25,0,0.25,0.0625,0.5,0,0.125,0.015625\n"
            "1,2,2,0.25,2,0.5590169943749475,4,0.5,,\n");  // hypot(0.25, 2 x 0.25)
  EXPECT_EQ(KappaCsv({Row(1, 0.5, 0)}, {}).substr(csv.find('\n') + 1), "0,1,0.5,0,,,,,,\n");
}

}  // namespace
}  // namespace antigrasp
