#include "antigrasp/bundle/column_volumes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "antigrasp/sdf/orient2d.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

constexpr int kLines = 128;  // along either axis

// The lines, in steps of `dy` and `dz` from (y0, z0).
struct Lines {
  double y0, z0, dy, dz;
  double Y(int i) const { return y0 + (i + 0.5) * dy; }
  double Z(int j) const { return z0 + (j + 0.5) * dz; }
  // The lines with low <= y <= high.
  static std::pair<int, int> Range(double low, double high, double start, double step) {
    const double first = std::ceil((low - start) / step - 0.5);
    const double last = std::floor((high - start) / step - 0.5);
    return {static_cast<int>(std::max(first, 0.0)), static_cast<int>(std::min(last, kLines - 1.0))};
  }
};

struct Change {
  double x;
  int solid, parts;  // added to the number of those that the line is in, from x on
};
using Column = std::vector<Change>;

class Columns {
 public:
  explicit Columns(const BoundingBox& box)
      : lines_{box.min.y(), box.min.z(), box.Extent().y() / kLines, box.Extent().z() / kLines},
        columns_(static_cast<std::size_t>(kLines) * kLines) {}

  void AddFace(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
    const Point2 p{a.y(), a.z()}, q{b.y(), b.z()}, r{c.y(), c.z()};
    ForLines({{a.cwiseMin(b).cwiseMin(c)}, {a.cwiseMax(b).cwiseMax(c)}}, [&](double y, double z,
                                                                             Column* column) {
      // A line through an edge meets one of the two faces.
      const Point2 at{y, z};
      const int pq = Orient2dSignPerturbed(p, q, at), qr = Orient2dSignPerturbed(q, r, at),
                rp = Orient2dSignPerturbed(r, p, at);
      if (pq == 0 || pq != qr || qr != rp) return;
      const Vector3d normal = (b - a).cross(c - a);
      const double x = a.x() - (normal.y() * (y - a.y()) + normal.z() * (z - a.z())) / normal.x();
      column->push_back({x, -pq, 0});  // seen along x: faces towards -x open
    });
  }

  void AddPart(const ConvexPart& part) {
    ForLines(part.box, [&](double y, double z, Column* column) {
      double low = part.box.min.x(), high = part.box.max.x();
      for (const HalfSpace& plane : part.planes) {
        const double room = plane.offset - plane.normal.y() * y - plane.normal.z() * z;
        const double slope = plane.normal.x();
        if (std::abs(slope) * (high - low) < 1e-12 * std::abs(room)) {
          if (room < 0.0) return;
        } else if (slope > 0.0) {
          high = std::min(high, room / slope);
        } else {
          low = std::max(low, room / slope);
        }
        if (!(low < high)) return;
      }
      column->push_back({low, 0, 1});
      column->push_back({high, 0, -1});
    });
  }

  ColumnVolumes Sum() {
    ColumnVolumes volumes;
    const double area = lines_.dy * lines_.dz;
    for (Column& column : columns_) {
      std::stable_sort(column.begin(), column.end(),
                       [](const Change& a, const Change& b) { return a.x < b.x; });
      int solid = 0, parts = 0;
      for (std::size_t i = 0; i < column.size(); ++i) {
        if (i > 0) {
          const double volume = area * (column[i].x - column[i - 1].x);
          if (solid > 0) volumes.solid += volume;
          if (solid > 0 && parts <= 0) volumes.missing += volume;
          if (solid <= 0 && parts > 0) volumes.covered += volume;
        }
        solid += column[i].solid;
        parts += column[i].parts;
      }
    }
    return volumes;
  }

 private:
  template <typename Visit>
  void ForLines(const BoundingBox& box, const Visit& visit) {
    const auto [y0, y1] = Lines::Range(box.min.y(), box.max.y(), lines_.y0, lines_.dy);
    const auto [z0, z1] = Lines::Range(box.min.z(), box.max.z(), lines_.z0, lines_.dz);
    for (int j = z0; j <= z1; ++j) {
      for (int i = y0; i <= y1; ++i) {
        visit(lines_.Y(i), lines_.Z(j), &columns_[static_cast<std::size_t>(j * kLines + i)]);
      }
    }
  }

  Lines lines_;
  std::vector<Column> columns_;
};

}  // namespace

ColumnVolumes CompareVolumes(const TriangleMesh& solid, const std::vector<ConvexPart>& parts) {
  Columns columns(Bounds(solid));
  for (const auto& face : solid.faces) {
    const auto at = [&](std::size_t k) {
      return solid.vertices[static_cast<std::size_t>(face[k])];
    };
    columns.AddFace(at(0), at(1), at(2));
  }
  for (const ConvexPart& part : parts) columns.AddPart(part);
  return columns.Sum();
}

}  // namespace antigrasp
