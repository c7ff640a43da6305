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
  EXPECT_EQ(FormatDouble(1.0 / 3), "0.3333333333333333");
  EXPECT_EQ(FormatDouble(-2.5e17), "-2.5e+17");
  EXPECT_EQ(FormatDouble(6.0), "6");
  EXPECT_EQ(FormatDouble(100000.0), "1e+05");  // shorter than 100000
  EXPECT_EQ(FormatDouble(-0.0), "-0");
  EXPECT_EQ(FormatDouble(std::numeric_limits<double>::infinity()), "inf");
  EXPECT_EQ(FormatDouble(std::nan("")), "nan");
  EXPECT_EQ(FormatDouble(-std::numeric_limits<double>::infinity()), "-inf");
}

TEST(FormatDuration, ChoosesTheUnitAPersonWould) {
  EXPECT_EQ(FormatDuration(0.52), "0.5s");
  EXPECT_EQ(FormatDuration(42.3), "42s");
  EXPECT_EQ(FormatDuration(65), "1m 05s");
  EXPECT_EQ(FormatDuration(7800), "2h 10m");
  EXPECT_EQ(FormatDuration(9.9), "9.9s");
  EXPECT_EQ(FormatDuration(10), "10s");
  EXPECT_EQ(FormatDuration(59.4), "59s");
  EXPECT_EQ(FormatDuration(59.6), "1m 00s");
  EXPECT_EQ(FormatDuration(3599), "59m 59s");
  EXPECT_EQ(FormatDuration(3600), "1h 00m");
  EXPECT_EQ(FormatDuration(3 * 3600 + 4 * 60 + 59), "3h 04m");
}

TEST(NumberedName, FillsUpToSixDigits) {
  EXPECT_EQ(NumberedName("cylinders", 17), "cylinders-000017");
  EXPECT_EQ(NumberedName("x", 999999), "x-999999");
  EXPECT_EQ(NumberedName("x", 1000000), "x-1000000");
}

TEST(CsvField, QuotesOnlyWhatWouldBreakARow) {
  EXPECT_EQ(CsvField("mug.stl"), "mug.stl");
  EXPECT_EQ(CsvField("a,b"), "\"a,b\"");
  EXPECT_EQ(CsvField("say \"hi\""), "\"say \"\"hi\"\"\"");
  EXPECT_EQ(CsvField("two\nlines"), "\"two\nlines\"");
  EXPECT_EQ(CsvField("\r"), "\"\r\"");
  EXPECT_EQ(CsvField(" "), " ");
  EXPECT_EQ(CsvField(""), "");
}

}  // namespace
}  // namespace antigrasp
