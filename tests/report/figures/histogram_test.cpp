#include "antigrasp/report/figures/histogram.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace antigrasp {
namespace {

const double kNone = std::nan("");

TEST(Histogram, BinsHoldTheirLowerEdgeAndTheLastOneTheEndOfTheRange) {
  const Histogram h = MakeHistogram({0.0, 0.24, 0.25, 0.5, 0.99, 1.0}, 0.0, 1.0, 4);
  EXPECT_EQ(h.counts, (std::vector<int>{2, 1, 1, 2}));
  EXPECT_EQ(h.Edge(0), 0.0);
  EXPECT_EQ(h.Edge(4), 1.0);
}

TEST(Histogram, EveryNumberIsInSomeBinAndWhatIsNoneIsCountedApart) {
  const Histogram h = MakeHistogram({-5.0, 0.1, kNone, 0.9, 8.0, INFINITY, kNone}, 0.0, 1.0, 5);
  EXPECT_EQ(h.Total(), 5);
  EXPECT_EQ(h.left_out, 2);
  EXPECT_EQ(h.counts.front(), 2);  // -5 and 0.1
  EXPECT_EQ(h.counts.back(), 3);
}

TEST(Histogram, SharesSumToOneAndAreZeroOfNothing) {
  const Histogram h = MakeHistogram({0.1, 0.2, 0.3, 0.7}, 0.0, 1.0, 3);
  double sum = 0.0;
  for (int k = 0; k < 3; ++k) sum += h.Share(k);
  EXPECT_NEAR(sum, 1.0, 1e-12);
  EXPECT_EQ(h.LargestShare(), 0.75);
  const Histogram nothing = MakeHistogram({kNone}, 0.0, 1.0, 3);
  EXPECT_EQ(nothing.Total(), 0);
  EXPECT_EQ(nothing.LargestShare(), 0.0);
}

TEST(Histogram, ARangeMayBeginAnywhere) {
  const Histogram h = MakeHistogram({-2.0, -0.6, -0.5, 2.4, 4.0, 2.5, 3.0}, -2.0, 4.0, 4);
  EXPECT_EQ(h.counts, (std::vector<int>{2, 1, 1, 3}));  // edges -2, -0.5, 1, 2.5, 4
  for (int k = 0; k <= 4; ++k) EXPECT_EQ(h.Edge(k), -2.0 + 1.5 * k);
  EXPECT_EQ(h.Share(0), 2.0 / 7.0);
  EXPECT_EQ(h.Share(3), 3.0 / 7.0);
  EXPECT_EQ(MakeHistogram({1.0, std::nan(""), 3.0}, 0.0, 4.0, 2).Share(0), 0.5);  // of the numbers
}

TEST(Histogram, RefusesARangeWithoutExtent) {
  EXPECT_THROW(MakeHistogram({1.0}, 1.0, 1.0, 3), std::logic_error);
  EXPECT_THROW(MakeHistogram({1.0}, 0.0, kNone, 3), std::logic_error);
  EXPECT_THROW(MakeHistogram({1.0}, 0.0, 1.0, 0), std::logic_error);
}

TEST(Histogram, ValuesAreDividedOneByOne) {
  EXPECT_EQ(Divided({1.0, 3.0}, 2.0), (std::vector<double>{0.5, 1.5}));
}

}  // namespace
}  // namespace antigrasp
