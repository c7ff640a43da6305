#include "antigrasp/sdf/mesh_to_sdf.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "antigrasp/core/check.h"
#include "antigrasp/sdf/orient2d.h"
#include "antigrasp/sdf/triangle_tree.h"

namespace antigrasp {
namespace {

// Nodes first..last (both included, maybe none) with coordinates in [low, high], one axis.
struct NodeRange {
  int first, last;
  NodeRange(const SdfGrid& grid, int axis, double low, double high) {
    const auto index = [&](double v) { return (v - grid.origin[axis]) / grid.spacing; };
    // A node too many on each side costs nothing: the caller tests exactly.
    first = static_cast<int>(std::clamp(std::floor(index(low)), 0.0, 1.0 * grid.n));
    last = static_cast<int>(std::clamp(std::ceil(index(high)), -1.0, grid.n - 1.0));
  }
};

// Parity of the crossings of each row of x, exact in y and z: the row is moved by an infinitely
// small step, so that it never meets an edge or a vertex and never runs inside a face.
class RowCrossings {
 public:
  RowCrossings(const TriangleMesh& mesh, const SdfGrid& grid)
      : grid_(grid), flips_(Nodes() * (Nodes() + 1) * Nodes(), 0) {
    for (const auto& face : mesh.faces) {
      AddFace({mesh.vertices[face[0]], mesh.vertices[face[1]], mesh.vertices[face[2]]});
    }
  }

  // One entry for each node of the row: 1 = inside.
  std::vector<char> InsideOfRow(int y, int z) const {
    std::vector<char> inside(Nodes());
    const char* flips = flips_.data() + RowStart(y, z);
    char parity = 0;
    for (std::size_t x = 0; x < Nodes(); ++x) {
      parity = static_cast<char>(parity ^ flips[x]);
      inside[x] = parity;
    }
    AG_CHECK((parity ^ flips[Nodes()]) == 0, "signed distance to a mesh that is not closed");
    return inside;
  }

 private:
  using Face = std::array<Eigen::Vector3d, 3>;

  std::size_t Nodes() const { return static_cast<std::size_t>(grid_.n); }
  std::size_t RowStart(int y, int z) const {
    return (static_cast<std::size_t>(z) * Nodes() + static_cast<std::size_t>(y)) * (Nodes() + 1);
  }

  void AddFace(const Face& face) {
    const Eigen::Vector3d min = face[0].cwiseMin(face[1]).cwiseMin(face[2]);
    const Eigen::Vector3d max = face[0].cwiseMax(face[1]).cwiseMax(face[2]);
    const NodeRange ys(grid_, 1, min.y(), max.y()), zs(grid_, 2, min.z(), max.z());
    for (int z = zs.first; z <= zs.last; ++z) {
      for (int y = ys.first; y <= ys.last; ++y) {
        const Eigen::Vector3d row = grid_.Node(0, y, z);
        if (!RowMeets(face, {row.y(), row.z()})) continue;
        const double x = std::clamp(CrossingX(face, row), min.x(), max.x());
        flips_[RowStart(y, z) + FirstNodeBeyond(x)] ^= 1;
      }
    }
  }

  static bool RowMeets(const Face& face, const Point2& row) {
    const Point2 a{face[0].y(), face[0].z()}, b{face[1].y(), face[1].z()};
    const Point2 c{face[2].y(), face[2].z()};
    const int side = Orient2dSignPerturbed(a, b, row);
    return side != 0 && Orient2dSignPerturbed(b, c, row) == side &&
           Orient2dSignPerturbed(c, a, row) == side;
  }

  // Rounding moves the crossing along a face that is nearly parallel to the row, that is, only over
  // nodes whose distance is zero to rounding.
  static double CrossingX(const Face& face, const Eigen::Vector3d& row) {
    const Eigen::Vector3d u = face[1] - face[0], v = face[2] - face[0];
    const double nx = u.y() * v.z() - u.z() * v.y();
    const double ny = u.z() * v.x() - u.x() * v.z();
    const double nz = u.x() * v.y() - u.y() * v.x();
    if (nx == 0.0) return face[0].x();
    return face[0].x() - (ny * (row.y() - face[0].y()) + nz * (row.z() - face[0].z())) / nx;
  }

  std::size_t FirstNodeBeyond(double x) const {
    const double guess = std::ceil((x - grid_.origin.x()) / grid_.spacing);
    auto node = static_cast<std::size_t>(std::clamp(guess, 0.0, 1.0 * grid_.n));
    while (node > 0 && NodeX(node - 1) > x) --node;
    while (node < Nodes() && NodeX(node) <= x) ++node;
    return node;
  }
  double NodeX(std::size_t node) const { return grid_.Node(static_cast<int>(node), 0, 0).x(); }

  const SdfGrid& grid_;
  std::vector<char> flips_;  // per row: crossings before node 0, between nodes, after the last
};

// Nodes from x on; behind the end of the grid the last one again.
TriangleTree::Row RowOfNodes(const SdfGrid& grid, int x, int y, int z) {
  const Eigen::Vector3d first = grid.Node(x, y, z);
  TriangleTree::Row row{{}, first.y(), first.z()};
  for (std::size_t i = 0; i < row.x.size(); ++i) {
    row.x[i] = grid.Node(std::min(x + static_cast<int>(i), grid.n - 1), y, z).x();
  }
  return row;
}

}  // namespace

void MeshToSdf(const TriangleMesh& mesh, SdfGrid* grid) {
  AG_CHECK(grid->n > 0 && grid->n < 800 && grid->spacing > 0.0 && grid->origin.allFinite(),
           "grid placement");
  const TriangleTree tree(mesh);
  const RowCrossings crossings(mesh, *grid);
  const auto n = static_cast<std::size_t>(grid->n);
  grid->values.resize(n * n * n);
  std::int32_t hint = 0;
  for (int z = 0; z < grid->n; ++z) {
    for (int y = 0; y < grid->n; ++y) {
      const std::vector<char> inside = crossings.InsideOfRow(y, z);
      for (int x = 0; x < grid->n; x += TriangleTree::kRowPoints) {
        const auto hits = tree.Nearest(RowOfNodes(*grid, x, y, z), hint);
        hint = hits[0].triangle;
        for (int i = 0; i < TriangleTree::kRowPoints && x + i < grid->n; ++i) {
          const auto distance =
              static_cast<float>(std::sqrt(hits[static_cast<std::size_t>(i)].squared_distance));
          grid->values[grid->Index(x + i, y, z)] =
              inside[static_cast<std::size_t>(x + i)] != 0 ? distance : -distance;
        }
      }
    }
  }
}

struct MeshDistance::Impl {
  TriangleTree tree;
};

MeshDistance::MeshDistance(const TriangleMesh& mesh)
    : impl_(std::make_unique<Impl>(Impl{TriangleTree(mesh)})) {}
MeshDistance::~MeshDistance() = default;

double MeshDistance::Unsigned(const Eigen::Vector3d& point) const {
  return std::sqrt(impl_->tree.Nearest(point).squared_distance);
}

}  // namespace antigrasp
