#include "antigrasp/report/page/deflated_part.h"

#include <gtest/gtest.h>

#include "tests/report/page/inflated.h"

namespace antigrasp {
namespace {

TEST(DeflatedPart, IsARawStream) {
  // A final block of fixed codes: 'a' (61 hex) is 10010001, then seven zeros end it.
  const DeflatedPart one = Deflated("a");
  EXPECT_EQ(one.stream, std::string("\x4b\x04\x00", 3));
  EXPECT_EQ(one.size, 1u);
}

TEST(DeflatedPart, OfNothingIsNothing) {
  EXPECT_EQ(Deflated("").stream, "");
  EXPECT_EQ(Deflated("").size, 0u);
}

TEST(DeflatedPart, InflatesToItsBytes) {
  std::string mixed;
  for (unsigned i = 0; i < 100000; ++i) mixed += static_cast<char>(i * i / 7);
  const DeflatedPart part = Deflated(mixed);
  EXPECT_EQ(part.size, mixed.size());
  EXPECT_EQ(Inflated(part.stream, part.size), mixed);
  const DeflatedPart zeros = Deflated(std::string(1 << 20, '\0'));
  EXPECT_LT(zeros.stream.size(), 1100u);  // 1,032 bytes become one
  EXPECT_EQ(Inflated(zeros.stream, zeros.size), std::string(1 << 20, '\0'));
}

}  // namespace
}  // namespace antigrasp
