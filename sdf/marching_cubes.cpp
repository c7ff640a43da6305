#include "antigrasp/sdf/marching_cubes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>

#include "antigrasp/core/check.h"
#include "antigrasp/sdf/cell_table.h"

namespace antigrasp {
namespace {

// The grid with one more layer of outside on every side, so that every surface is closed.
struct PaddedField {
  std::size_t side;
  std::vector<float> values;

  explicit PaddedField(const SdfGrid& grid) : side(static_cast<std::size_t>(grid.n) + 2) {
    const auto n = static_cast<std::size_t>(grid.n);
    values.assign(side * side * side, -static_cast<float>(grid.spacing));
    for (std::size_t z = 0; z < n; ++z) {
      for (std::size_t y = 0; y < n; ++y) {
        const auto row = grid.values.begin() + static_cast<std::ptrdiff_t>((z * n + y) * n);
        std::copy_n(row, n, values.begin() + static_cast<std::ptrdiff_t>(Index(1, y + 1, z + 1)));
      }
    }
  }

  std::size_t Index(std::size_t x, std::size_t y, std::size_t z) const {
    return (z * side + y) * side + x;
  }
};

void CheckGrid(const SdfGrid& grid, double clamp) {
  const auto n = static_cast<std::size_t>(std::max(grid.n, 0));
  AG_CHECK(n > 0 && n < 800 && grid.values.size() == n * n * n, "grid size");
  AG_CHECK(std::isfinite(grid.spacing) && grid.spacing > 0.0 && grid.origin.allFinite(),
           "grid placement");
  AG_CHECK(clamp >= 0.001 && clamp <= 0.5, "clamp outside [0.001, 0.5]");
  AG_CHECK(
      std::all_of(grid.values.begin(), grid.values.end(), [](float v) { return std::isfinite(v); }),
      "non-finite value in the grid");
}

// Where the field is zero between an inside (> 0) and an outside (<= 0) end.
double CrossingParameter(double from, double to, double clamp) {
  return std::clamp(from / (from - to), clamp, 1.0 - clamp);
}

// One vertex for each grid edge that crosses the surface; its index goes to slot 3 * node + axis of
// the returned array, whose other slots stay unset. Vertices are shared through that index and
// never welded by position.
std::unique_ptr<std::int32_t[]> PlaceVertices(const PaddedField& field, const SdfGrid& grid,
                                              double clamp, TriangleMesh* mesh) {
  auto slots = std::make_unique_for_overwrite<std::int32_t[]>(3 * field.values.size());
  const std::size_t m = field.side;
  const std::array<std::size_t, 3> stride = {1, m, m * m};
  std::array<std::size_t, 3> p{};
  for (p[2] = 0; p[2] < m; ++p[2]) {
    for (p[1] = 0; p[1] < m; ++p[1]) {
      for (p[0] = 0; p[0] < m; ++p[0]) {
        const std::size_t node = field.Index(p[0], p[1], p[2]);
        const float from = field.values[node];
        for (std::size_t axis = 0; axis < 3; ++axis) {
          if (p[axis] + 1 == m) continue;
          const float to = field.values[node + stride[axis]];
          if ((from > 0.0F) == (to > 0.0F)) continue;
          Eigen::Vector3d index(static_cast<double>(p[0]), static_cast<double>(p[1]),
                                static_cast<double>(p[2]));
          index[static_cast<int>(axis)] += CrossingParameter(from, to, clamp);
          slots[3 * node + axis] = static_cast<std::int32_t>(mesh->vertices.size());
          mesh->vertices.push_back(grid.origin + grid.spacing * (index.array() - 1.0).matrix());
        }
      }
    }
  }
  return slots;
}

void PlaceFaces(const PaddedField& field, const std::int32_t* slots, TriangleMesh* mesh) {
  const auto& table = CellTable();
  const std::size_t m = field.side;
  std::array<std::size_t, 8> corner{};
  for (std::size_t c = 0; c < 8; ++c) corner[c] = field.Index(c & 1, c >> 1 & 1, c >> 2 & 1);
  std::array<std::size_t, kCellEdges> edge_slot{};
  for (int e = 0; e < kCellEdges; ++e) {
    edge_slot[e] = 3 * corner[CellEdgeLow(e)] + static_cast<std::size_t>(e / 4);
  }
  for (std::size_t z = 0; z + 1 < m; ++z) {
    for (std::size_t y = 0; y + 1 < m; ++y) {
      for (std::size_t x = 0; x + 1 < m; ++x) {
        const std::size_t node = field.Index(x, y, z);
        unsigned cell_case = 0;
        for (std::size_t c = 0; c < 8; ++c) {
          cell_case |= static_cast<unsigned>(field.values[node + corner[c]] > 0.0F) << c;
        }
        for (const CellTriangle& t : table[cell_case]) {
          const std::int32_t* slot = slots + 3 * node;
          mesh->faces.push_back(
              {slot[edge_slot[t[0]]], slot[edge_slot[t[1]]], slot[edge_slot[t[2]]]});
        }
      }
    }
  }
}

}  // namespace

TriangleMesh MarchingCubes(const SdfGrid& grid, double clamp) {
  CheckGrid(grid, clamp);
  const PaddedField field(grid);
  TriangleMesh mesh;
  mesh.vertices.reserve(4096);
  mesh.faces.reserve(8192);
  const auto slots = PlaceVertices(field, grid, clamp, &mesh);
  PlaceFaces(field, slots.get(), &mesh);
  return mesh;
}

}  // namespace antigrasp
