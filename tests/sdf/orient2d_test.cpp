#include "antigrasp/sdf/orient2d.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

namespace antigrasp {
namespace {

TEST(Orient2d, KnowsLeftRightAndStraight) {
  EXPECT_EQ(Orient2dSign({0, 0}, {1, 0}, {0, 1}), 1);
  EXPECT_EQ(Orient2dSign({0, 0}, {1, 0}, {0, -1}), -1);
  EXPECT_EQ(Orient2dSign({0, 0}, {1, 1}, {3, 3}), 0);
}

// The classic failure of the plain determinant (Kettner et al., "Classroom examples of robustness
// problems"): points a few units in the last place around the line y = x.
TEST(Orient2d, IsExactNextToALine) {
  const double step = std::ldexp(1.0, -53);
  // The determinant rounds to 0 on the first line, to the wrong sign on the second.
  for (const auto& [from, to] : {std::pair(12.0, 24.0), std::pair(8.1, 24.7)}) {
    const Point2 q{from, from}, r{to, to};
    for (int i = 0; i < 32; ++i) {
      for (int j = 0; j < 32; ++j) {
        const Point2 p{0.5 + i * step, 0.5 + j * step};
        const int expected = (p.y > p.x) - (p.y < p.x);  // left of q -> r is above
        EXPECT_EQ(Orient2dSign(q, r, p), expected) << i << " " << j;
        EXPECT_EQ(Orient2dSign(r, q, p), -expected);
        EXPECT_EQ(Orient2dSign(p, q, r), expected);
      }
    }
  }
}

TEST(Orient2d, PerturbationBreaksTiesTheSameWayForBothDirections) {
  const Point2 a{0, 0}, b{1, 1}, c{2, 0}, on_ab{0.5, 0.5}, on_ac{1, 0};
  EXPECT_EQ(Orient2dSignPerturbed(a, b, on_ab), -1);  // moved to +x: right of a -> b
  EXPECT_EQ(Orient2dSignPerturbed(b, a, on_ab), 1);
  EXPECT_EQ(Orient2dSignPerturbed(a, c, on_ac), 1);  // moved up by less: left of a -> c
  EXPECT_EQ(Orient2dSignPerturbed(c, a, on_ac), -1);
  EXPECT_EQ(Orient2dSignPerturbed(a, a, on_ac), 0);
}

}  // namespace
}  // namespace antigrasp
