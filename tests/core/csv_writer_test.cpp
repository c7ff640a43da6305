#include "antigrasp/core/csv_writer.h"

#include <gtest/gtest.h>

#include <cmath>

#include "antigrasp/core/check.h"

namespace antigrasp {
namespace {

TEST(CsvWriter, WritesAHeaderAndRowsOfEveryKindOfField) {
  CsvWriter csv({"object", "n", "x", "y", "z", "u", "v"});
  csv.Text("a, \"b\"").Count(3).Number(0.1).NumberOrGap(std::nan("")).CountOrGap(-1);
  csv.NumbersOrGaps({-2.5, std::nan("")});
  csv.EndRow();
  csv.Text("c").Count(-4).Number(std::nan("")).NumberOrGap(7.0).CountOrGap(0).Numbers({1e-9, 2.0});
  csv.EndRow();
  EXPECT_EQ(csv.text(),
            "object,n,x,y,z,u,v\n"
            "\"a, \"\"b\"\"\",3,0.1,,,-2.5,\n"
            "c,-4,nan,7,0,1e-09,2\n");
}

TEST(CsvWriter, RefusesARowOfAnotherLengthThanTheHeader) {
  CsvWriter csv({"object", "x"});
  csv.Text("short");
  EXPECT_THROW(csv.EndRow(), std::logic_error);
  csv.Number(1.0).Number(2.0);
  EXPECT_THROW(csv.EndRow(), std::logic_error);
}

TEST(CsvWriter, WhatIsTakenBitByBitIsTheTable) {
  CsvWriter csv({"a", "b"}), whole({"a", "b"});
  std::string taken;
  for (const int i : {1, 2, 3}) {
    csv.Count(i).Text("x").EndRow();
    whole.Count(i).Text("x").EndRow();
    if (i != 2) taken += csv.TakeText();
  }
  EXPECT_EQ(taken, whole.text());
  EXPECT_EQ(csv.TakeText(), "");
}

}  // namespace
}  // namespace antigrasp
