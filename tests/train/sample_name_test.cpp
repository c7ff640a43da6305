#include "antigrasp/train/sample_name.h"

#include <gtest/gtest.h>

namespace antigrasp {
namespace {

TEST(SampleName, HasSixDigitsOrMore) {
  EXPECT_EQ(SampleName(0), "sample-000000");
  EXPECT_EQ(SampleName(1234567), "sample-1234567");
}

TEST(SampleIndex, KnowsTheNamesOfOlderRunsToo) {
  for (const char* name : {"sample-000012", "sample-12", "12"}) EXPECT_EQ(SampleIndex(name), 12);
  EXPECT_EQ(SampleIndex(SampleName(1234567)), 1234567);
}

TEST(SampleIndex, OfAnyOtherTextIsNone) {
  for (const char* name :
       {"", "sample", "sample-", "sample--1", "-1", "sample-1x", "12 ", "mug-3"}) {
    EXPECT_EQ(SampleIndex(name), std::nullopt) << name;
  }
}

}  // namespace
}  // namespace antigrasp
