#include "antigrasp/contact/triangle_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace antigrasp {
namespace {

using Eigen::Vector3d;

constexpr float kNowhere = std::numeric_limits<float>::infinity();

float RoundedDown(double value) { return std::nextafter(static_cast<float>(value), -kNowhere); }
float RoundedUp(double value) { return std::nextafter(static_cast<float>(value), kNowhere); }

struct Range {
  std::int32_t* first;
  std::int32_t* last;
};

// Halves along the longest side of the box around the centres. The order is total, so that equal
// meshes have equal trees.
std::int32_t* Halve(const std::vector<Vector3d>& centers, Range range) {
  Vector3d low = centers[*range.first];
  Vector3d high = low;
  for (const std::int32_t* f = range.first; f != range.last; ++f) {
    low = low.cwiseMin(centers[*f]);
    high = high.cwiseMax(centers[*f]);
  }
  Eigen::Index axis = 0;
  (high - low).maxCoeff(&axis);
  std::int32_t* middle = range.first + (range.last - range.first) / 2;
  std::nth_element(range.first, middle, range.last, [&](std::int32_t a, std::int32_t b) {
    return std::tie(centers[a][axis], a) < std::tie(centers[b][axis], b);
  });
  return middle;
}

}  // namespace

TriangleTree::TriangleTree(const TriangleMesh& mesh, const std::vector<std::int32_t>& faces) {
  if (faces.empty()) return;
  std::vector<std::int32_t> order = faces;
  centers_.resize(mesh.faces.size());
  low_ = high_ = mesh.vertices[mesh.faces[faces.front()][0]];
  for (const std::int32_t f : faces) {
    const auto& [a, b, c] = mesh.faces[f];
    const Vector3d low = mesh.vertices[a].cwiseMin(mesh.vertices[b]).cwiseMin(mesh.vertices[c]);
    const Vector3d high = mesh.vertices[a].cwiseMax(mesh.vertices[b]).cwiseMax(mesh.vertices[c]);
    centers_[f] = 0.5 * (low + high);
    low_ = low_.cwiseMin(low);
    high_ = high_.cwiseMax(high);
  }
  span_ = std::max(low_.cwiseAbs().maxCoeff(), high_.cwiseAbs().maxCoeff());
  nodes_.reserve(faces.size() / 2 + 1);
  nodes_.emplace_back();
  Build(mesh, order.data(), order.data() + order.size(), 0);
  centers_ = {};
}

void TriangleTree::Build(const TriangleMesh& mesh, std::int32_t* first, std::int32_t* last,
                         std::size_t at) {
  std::array<Range, 4> parts;
  std::size_t count = 0;
  if (last - first <= 4) {
    for (std::int32_t* f = first; f != last; ++f) parts[count++] = {f, f + 1};
  } else {
    std::int32_t* middle = Halve(centers_, {first, last});
    std::int32_t* quarter = Halve(centers_, {first, middle});
    std::int32_t* three_quarters = Halve(centers_, {middle, last});
    parts = {
        {{first, quarter}, {quarter, middle}, {middle, three_quarters}, {three_quarters, last}}};
    count = 4;
  }
  for (std::size_t k = 0; k < 4; ++k) {
    Node& node = nodes_[at];
    node.child[k] = ~0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      float& low = node.low[axis][static_cast<Eigen::Index>(k)];
      float& high = node.high[axis][static_cast<Eigen::Index>(k)];
      low = high = kNowhere;
      if (k >= count) continue;
      high = -kNowhere;
      for (const std::int32_t* f = parts[k].first; f != parts[k].last; ++f) {
        for (const std::int32_t v : mesh.faces[*f]) {
          low = std::min(low, RoundedDown(mesh.vertices[v][static_cast<Eigen::Index>(axis)]));
          high = std::max(high, RoundedUp(mesh.vertices[v][static_cast<Eigen::Index>(axis)]));
        }
      }
    }
    if (k >= count) continue;
    if (parts[k].last - parts[k].first == 1) {
      node.child[k] = ~*parts[k].first;
    } else {
      const std::size_t child = nodes_.size();
      node.child[k] = static_cast<std::int32_t>(child);
      nodes_.emplace_back();  // `node` is no longer valid
      Build(mesh, parts[k].first, parts[k].last, child);
    }
  }
}

TriangleTree::PointProbe::PointProbe(const Vector3d& place) {
  for (std::size_t k = 0; k < 3; ++k) at[k] = static_cast<float>(place[static_cast<int>(k)]);
}

TriangleTree::BoxProbe::BoxProbe(const PadPose& box) {
  for (std::size_t k = 0; k < 3; ++k) {
    const auto column = static_cast<Eigen::Index>(k);
    for (std::size_t i = 0; i < 3; ++i) {
      axis[k][i] = static_cast<float>(box.axes(static_cast<Eigen::Index>(i), column));
    }
    middle[k] = static_cast<float>(box.axes.col(column).dot(box.center));
    half[k] = RoundedUp(box.half[column]);
  }
}

}  // namespace antigrasp
