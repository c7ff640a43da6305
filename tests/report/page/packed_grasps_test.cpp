#include "antigrasp/report/page/packed_grasps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>

namespace antigrasp {
namespace {

constexpr std::size_t kColumns = 16;

template <typename T>
T At(const std::string& bytes, std::size_t offset) {
  T value{};
  EXPECT_LE(offset + sizeof value, bytes.size());
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

float Value(const std::string& bytes, std::size_t count, std::size_t column, std::size_t grasp) {
  const auto low = At<float>(bytes, 4 * count + 8 * column);
  const auto high = At<float>(bytes, 4 * count + 8 * column + 4);
  const auto q = At<std::uint16_t>(bytes, 4 * count + 8 * kColumns + 2 * (column * count + grasp));
  return low + static_cast<float>(q) / 65535.0F * (high - low);
}

ScoredGrasp GraspOf(double quality, double shift) {
  ScoredGrasp scored;
  scored.quality = quality;
  scored.grasp.contacts[0] = {{-0.02, 0.01 + shift, 0.03}, {-1.0, 0.0, 0.0}};
  scored.grasp.contacts[1] = {{0.02, 0.01, 0.03 - shift}, {0.6, 0.8, 0.0}};
  scored.grasp.approach = {0.0, 0.0, -1.0};
  scored.grasp.width = 0.04 + shift;
  return scored;
}

TEST(PackedGrasps, OfOneGraspAreItsNumbersInTheUnitOfTheMesh) {
  const std::string bytes = PackGrasps({GraspOf(0.25, 0.0)}, 0.01);
  ASSERT_EQ(bytes.size(), 36u + 128u);
  EXPECT_EQ(bytes.substr(0, 4), std::string("\x00\x00\x80\x3e", 4));                  // 0.25
  EXPECT_EQ(bytes.substr(4, 8), std::string("\x00\x00\x00\xc0\x00\x00\x00\xc0", 8));  // -2 to -2
  const float expected[kColumns] = {-2, 1, 3, 2, 1, 3, -1, 0, 0, 0.6F, 0.8F, 0, 0, 0, -1, 4};
  for (std::size_t k = 0; k < kColumns; ++k)
    EXPECT_FLOAT_EQ(Value(bytes, 1, k, 0), expected[k]) << k;
}

TEST(PackedGrasps, ComeBestFirstAndSpanTheirColumns) {
  const std::string bytes =
      PackGrasps({GraspOf(0.001, 0.0), GraspOf(0.003, 0.001), GraspOf(0.002, 0.004)}, 0.01);
  ASSERT_EQ(bytes.size(), 3 * 36u + 128u);
  const float qualities[] = {0.003F, 0.002F, 0.001F};
  const float shifts[] = {0.1F, 0.4F, 0.0F};
  for (std::size_t g = 0; g < 3; ++g) {
    EXPECT_EQ(At<float>(bytes, 4 * g), qualities[g]);
    EXPECT_NEAR(Value(bytes, 3, 1, g), 1.0F + shifts[g], 0.4 / 65535);
    EXPECT_NEAR(Value(bytes, 3, 5, g), 3.0F - shifts[g], 0.4 / 65535);
    EXPECT_NEAR(Value(bytes, 3, 15, g), 4.0F + shifts[g], 0.4 / 65535);
  }
  // The best one lies at a quarter of the width's range: 16383.75 of 65535 steps.
  EXPECT_EQ(bytes.substr(3 * 4 + 8 * kColumns + 2 * 3 * 15),
            std::string("\x00\x40\xff\xff\x00\x00", 6));
}

TEST(PackedGrasps, OfNoGraspAreNoBytesAndWhatIsNoNumberIsZero) {
  EXPECT_EQ(PackGrasps({}, 1.0), "");
  ScoredGrasp broken = GraspOf(0.5, 0.0);
  broken.grasp.width = std::nan("");
  broken.grasp.approach.x() = INFINITY;
  const std::string bytes = PackGrasps({broken}, 1.0);
  EXPECT_EQ(Value(bytes, 1, 15, 0), 0.0F);
  EXPECT_EQ(Value(bytes, 1, 12, 0), 0.0F);
  EXPECT_EQ(Value(bytes, 1, 14, 0), -1.0F);
}

}  // namespace
}  // namespace antigrasp
