#include "antigrasp/report/page/packed_grasps.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

namespace antigrasp {
namespace {

using Eigen::Vector3d;

constexpr std::size_t kColumns = 16;
constexpr double kColumnSteps = 65535.0;
constexpr double kLargestNumber = 1e30;  // of a float32 with room for differences

using Row = std::array<float, kColumns>;

float Number(double value) {
  return std::isfinite(value)
             ? static_cast<float>(std::clamp(value, -kLargestNumber, kLargestNumber))
             : 0.0F;
}

Row RowOf(const Grasp& grasp, double metres_per_unit) {
  Row row{};
  std::size_t at = 0;
  const auto add = [&](const Vector3d& v) {
    for (int k = 0; k < 3; ++k) row[at++] = Number(v[k]);
  };
  for (const Contact& contact : grasp.contacts) add(contact.point / metres_per_unit);
  for (const Contact& contact : grasp.contacts) add(contact.normal);
  add(grasp.approach);
  row[at] = Number(grasp.width / metres_per_unit);
  return row;
}

template <typename T>
void Append(T value, std::string* bytes) {
  static_assert(std::endian::native == std::endian::little);
  bytes->append(reinterpret_cast<const char*>(&value), sizeof value);
}

}  // namespace

std::string PackGrasps(std::vector<ScoredGrasp> grasps, double metres_per_unit) {
  if (grasps.empty()) return {};
  std::stable_sort(grasps.begin(), grasps.end(), [](const ScoredGrasp& a, const ScoredGrasp& b) {
    return a.quality > b.quality;
  });
  std::string bytes;
  std::vector<Row> rows;
  for (const ScoredGrasp& scored : grasps) {
    Append(static_cast<float>(scored.quality), &bytes);
    rows.push_back(RowOf(scored.grasp, metres_per_unit));
  }
  Row low = rows.front(), high = rows.front();
  for (const Row& row : rows) {
    for (std::size_t k = 0; k < kColumns; ++k) {
      low[k] = std::min(low[k], row[k]);
      high[k] = std::max(high[k], row[k]);
    }
  }
  for (std::size_t k = 0; k < kColumns; ++k) {
    Append(low[k], &bytes);
    Append(high[k], &bytes);
  }
  for (std::size_t k = 0; k < kColumns; ++k) {
    const double extent = double{high[k]} - double{low[k]};
    for (const Row& row : rows) {
      const double share = extent > 0.0 ? (double{row[k]} - double{low[k]}) / extent : 0.0;
      Append(static_cast<std::uint16_t>(std::lround(share * kColumnSteps)), &bytes);
    }
  }
  return bytes;
}

}  // namespace antigrasp
