#include "antigrasp/mesh/weld.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>

namespace antigrasp {
namespace {

bool Before(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::tie(a.x(), a.y(), a.z()) < std::tie(b.x(), b.y(), b.z());
}

// Sorted by position, equal ones by index.
std::vector<std::int32_t> SortedOrder(const std::vector<Eigen::Vector3d>& positions) {
  std::vector<std::int32_t> order(positions.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) {
    if (Before(positions[a], positions[b])) return true;
    if (Before(positions[b], positions[a])) return false;
    return a < b;
  });
  return order;
}

// Numbers of a cubic cell in space, whole but kept as doubles: they can be large.
using Cell = std::array<double, 3>;

bool AnyNear(const std::vector<Eigen::Vector3d>& positions, const std::vector<std::int32_t>& some,
             const std::vector<std::int32_t>& others, double tolerance) {
  return std::any_of(some.begin(), some.end(), [&](std::int32_t a) {
    return std::any_of(others.begin(), others.end(), [&](std::int32_t b) {
      return (positions[a] - positions[b]).norm() <= tolerance;
    });
  });
}

}  // namespace

std::vector<std::int32_t> FirstEqual(const std::vector<Eigen::Vector3d>& positions) {
  const std::vector<std::int32_t> order = SortedOrder(positions);
  std::vector<std::int32_t> first(positions.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool same = i > 0 && positions[order[i]] == positions[order[i - 1]];
    first[order[i]] = same ? first[order[i - 1]] : order[i];
  }
  return first;
}

std::vector<std::int32_t> FirstNear(const std::vector<Eigen::Vector3d>& positions,
                                    double tolerance) {
  std::vector<std::int32_t> parent(positions.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](std::int32_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  const auto join = [&](std::int32_t a, std::int32_t b) {
    a = root(a);
    b = root(b);
    parent[std::max(a, b)] = std::min(a, b);
  };
  // The diagonal of a cell is the tolerance, so all positions in one belong together, and others
  // that do are at most two cells away.
  std::map<Cell, std::vector<std::int32_t>> cells;
  for (std::size_t i = 0; i < positions.size() && tolerance > 0.0; ++i) {
    const Eigen::Vector3d scaled = positions[i] * (std::sqrt(3.0) / tolerance);
    cells[{std::floor(scaled.x()), std::floor(scaled.y()), std::floor(scaled.z())}].push_back(
        static_cast<std::int32_t>(i));
  }
  for (const auto& [cell, members] : cells) {
    for (const std::int32_t member : members) join(members.front(), member);
    for (double x = cell[0]; x <= cell[0] + 2.0; ++x) {
      for (double y = cell[1] - 2.0; y <= cell[1] + 2.0; ++y) {
        // The cells of one row are neighbours in the map.
        auto it = cells.upper_bound(std::max(cell, Cell{x, y, cell[2] - 3.0}));
        for (; it != cells.end() && it->first <= Cell{x, y, cell[2] + 2.0}; ++it) {
          if (AnyNear(positions, members, it->second, tolerance)) {
            join(members.front(), it->second.front());
          }
        }
      }
    }
  }
  std::vector<std::int32_t> first(positions.size());
  for (std::size_t i = 0; i < first.size(); ++i) first[i] = root(static_cast<std::int32_t>(i));
  return first;
}

}  // namespace antigrasp
