#include "antigrasp/core/format.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace antigrasp {
namespace {

TEST(FormatDouble, ReadsBackToTheSameDouble) {
  for (const double value : {0.1, 1.0 / 3, 1e-300, -2.5e17, 0.0039}) {
    EXPECT_EQ(std::stod(FormatDouble(value)), value);
  }
  EXPECT_EQ(FormatDouble(0.1), "0.1");
  EXPECT_EQ(FormatDouble(std::nan("")), "nan");
  EXPECT_EQ(FormatDouble(-std::numeric_limits<double>::infinity()), "-inf");
}

TEST(FormatDuration, ChoosesTheUnitAPersonWould) {
  EXPECT_EQ(FormatDuration(0.52), "0.5s");
  EXPECT_EQ(FormatDuration(42.3), "42s");
  EXPECT_EQ(FormatDuration(65), "1m 05s");
  EXPECT_EQ(FormatDuration(7800), "2h 10m");
}

TEST(CsvField, QuotesOnlyWhatWouldBreakARow) {
  EXPECT_EQ(CsvField("mug.stl"), "mug.stl");
  EXPECT_EQ(CsvField("a,b"), "\"a,b\"");
  EXPECT_EQ(CsvField("say \"hi\""), "\"say \"\"hi\"\"\"");
  EXPECT_EQ(CsvField("two\nlines"), "\"two\nlines\"");
}

}  // namespace
}  // namespace antigrasp
