// F_a as a whole: two nodes of a tree over the faces at a time.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "antigrasp/core/rng.h"
#include "antigrasp/perturb/face_pairs.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

constexpr double kPi = std::numbers::pi;
constexpr std::int32_t kLeafSize = 8;
// Of two larger leaves as many pairs are drawn.
constexpr int kDraws = 2;
// Rounding in the angles of the bounds; what is nearer to the limit is looked at more closely.
constexpr double kAngleSlack = 1e-7;

double Angle(const Vector3d& unit_a, const Vector3d& unit_b) {
  return std::acos(std::clamp(unit_a.dot(unit_b), -1.0, 1.0));
}

// An angle with its cosine and sine.
struct Bend {
  explicit Bend(double radians = 0.0)
      : angle(radians), cosine(std::cos(radians)), sine(std::sin(radians)) {}
  double angle, cosine, sine;
};

struct Node {
  Vector3d center = Vector3d::Zero();  // of the enclosing ball
  double radius = 0.0;
  Vector3d axis = Vector3d::UnitX();
  double turn = 0.0;  // every normal is within it of the axis
  Bend most;          // psi + turn: beyond, a direction is in no friction cone of the node
  Bend least;         // psi - turn: within, it is in all of them; negative: never
  std::int32_t first = 0, count = 0;  // faces in the tree's order
  std::int32_t left = -1;             // the right child follows it; -1 for a leaf
};

class PairTree {
 public:
  PairTree(const TriangleMesh& mesh, const PairLimits& limits, std::int32_t leaf_size = kLeafSize)
      : test_(limits),
        psi_(limits.cone_angle),
        max_width_(test_.max_width()),
        leaf_size_(leaf_size) {
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
      const FaceShape shape(mesh, f);
      if (!shape.has_area()) continue;
      shapes_.push_back(shape);
      faces_.push_back(static_cast<std::int32_t>(f));
    }
    if (shapes_.empty()) return;
    const BoundingBox box = Bounds(mesh);
    place_scale_ = 2.0 / std::max(box.Extent().maxCoeff(), 1e-300);
    nodes_.reserve(shapes_.size());
    nodes_.emplace_back();
    Split(0, 0, static_cast<std::int32_t>(shapes_.size()));
  }

  // Calls block(x, y) for two nodes all of whose pairs are antipodal and leaves(x, y) for two
  // leaves that may hold such pairs and others, or twice for one leaf.
  template <typename Block, typename Leaves>
  void Visit(const Block& block, const Leaves& leaves) const {
    if (shapes_.empty()) return;
    std::vector<std::pair<std::int32_t, std::int32_t>> stack{{0, 0}};
    while (!stack.empty()) {
      const auto [x, y] = stack.back();
      stack.pop_back();
      const Node &a = nodes_[x], &b = nodes_[y];
      if (x == y) {
        if (2.0 * a.most.angle < kPi) continue;  // no two normals are opposite enough
        if (a.left < 0) {
          leaves(a, b);
        } else {
          stack.insert(stack.end(),
                       {{a.left, a.left}, {a.left + 1, a.left + 1}, {a.left, a.left + 1}});
        }
        continue;
      }
      const Verdict verdict = Compare(a, b);
      if (verdict == Verdict::kNone) continue;
      if (verdict == Verdict::kAll) {
        block(a, b);
      } else if (a.left < 0 && b.left < 0) {
        leaves(a, b);
      } else if (b.left < 0 || (a.left >= 0 && Size(a) > Size(b))) {
        stack.insert(stack.end(), {{a.left, y}, {a.left + 1, y}});
      } else {
        stack.insert(stack.end(), {{x, b.left}, {x, b.left + 1}});
      }
    }
  }

  // Calls pair(i, j) for the antipodal faces of two leaves, in the tree's order.
  template <typename Pair>
  void VisitPairs(const Node& a, const Node& b, const Pair& pair) const {
    for (std::int32_t i = a.first; i < a.first + a.count; ++i) {
      for (std::int32_t j = a.first == b.first ? i + 1 : b.first; j < b.first + b.count; ++j) {
        if (test_(shapes_[i], shapes_[j])) pair(i, j);
      }
    }
  }

  // How many pairs of two leaves are antipodal, by a few of them.
  std::int64_t EstimatePairs(const Node& a, const Node& b, RngStream* rng) const {
    const auto draw = [&](const Node& node) {
      return node.first +
             static_cast<std::int32_t>(rng->Below(static_cast<std::uint64_t>(node.count)));
    };
    int found = 0;
    for (int k = 0; k < kDraws; ++k) {
      const std::int32_t i = draw(a), j = draw(b);
      if (test_(shapes_[i], shapes_[j])) ++found;
    }
    return std::int64_t{found} * a.count * b.count / kDraws;
  }

  std::int32_t FaceAt(std::int32_t place) const { return faces_[place]; }

 private:
  enum class Verdict { kNone, kSome, kAll };

  // What is left undecided grows with the ball and with the spread of the normals.
  double Size(const Node& node) const { return node.radius * place_scale_ + node.turn; }

  // Every q - p is within `spread` = asin(reach / distance) of the line between the centres.
  Verdict Compare(const Node& a, const Node& b) const {
    const bool bounded = a.most.angle + b.most.angle < kPi;
    if (bounded &&
        -a.axis.dot(b.axis) < a.most.cosine * b.most.cosine - a.most.sine * b.most.sine) {
      return Verdict::kNone;
    }
    const Vector3d between = b.center - a.center;
    const double reach = a.radius + b.radius, squared = between.squaredNorm();
    if (squared <= reach * reach) return Verdict::kSome;
    const double distance = std::sqrt(squared), along = std::sqrt(squared - reach * reach);
    if (distance - reach > max_width_) return Verdict::kNone;
    const double at_a = -a.axis.dot(between), at_b = b.axis.dot(between);
    // cos(most + spread), where that is less than a half turn, and cos(least - spread).
    const auto outside = [&](double at, const Bend& most) {
      return (most.angle < 0.5 * kPi || (most.angle < kPi && reach < most.sine * distance)) &&
             at < most.cosine * along - most.sine * reach;
    };
    const auto inside = [&](double at, const Bend& least) {
      return least.angle > 0.0 && reach < least.sine * distance &&
             at > least.cosine * along + least.sine * reach;
    };
    if (outside(at_a, a.most) || outside(at_b, b.most)) return Verdict::kNone;
    const bool all =
        inside(at_a, a.least) && inside(at_b, b.least) && distance + reach < max_width_;
    return all ? Verdict::kAll : Verdict::kSome;
  }

  Node Bound(std::int32_t first, std::int32_t count) const {
    Node node;
    node.first = first;
    node.count = count;
    Vector3d min = shapes_[first].center, max = min, normals = Vector3d::Zero();
    for (std::int32_t i = first; i < first + count; ++i) {
      for (const Vector3d& corner : shapes_[i].corner) {
        min = min.cwiseMin(corner);
        max = max.cwiseMax(corner);
      }
      normals += shapes_[i].normal;
    }
    node.center = 0.5 * (min + max);
    node.axis = normals.norm() > 1e-9 ? Vector3d(normals.normalized()) : shapes_[first].normal;
    for (std::int32_t i = first; i < first + count; ++i) {
      for (const Vector3d& corner : shapes_[i].corner) {
        node.radius = std::max(node.radius, (corner - node.center).norm());
      }
      node.turn = std::max(node.turn, Angle(node.axis, shapes_[i].normal));
    }
    node.most = Bend(psi_ + node.turn + kAngleSlack);
    node.least = Bend(psi_ - node.turn - kAngleSlack);
    return node;
  }

  // Halves along the widest of six coordinates, place and normal: a box's sides part first.
  void Split(std::int32_t index, std::int32_t first, std::int32_t count) {
    nodes_[index] = Bound(first, count);
    if (count <= leaf_size_) return;
    using Key = Eigen::Matrix<double, 6, 1>;
    const auto key = [&](const FaceShape& shape) {
      Key k;
      k << place_scale_ * shape.center, shape.normal;
      return k;
    };
    Key min = key(shapes_[first]), max = min;
    for (std::int32_t i = first; i < first + count; ++i) {
      min = min.cwiseMin(key(shapes_[i]));
      max = max.cwiseMax(key(shapes_[i]));
    }
    int axis = 0;
    (max - min).maxCoeff(&axis);
    std::vector<std::int32_t> order(static_cast<std::size_t>(count));
    std::iota(order.begin(), order.end(), first);
    const std::int32_t half = count / 2;
    std::nth_element(order.begin(), order.begin() + half, order.end(),
                     [&](std::int32_t i, std::int32_t j) {
                       return std::pair(key(shapes_[i])[axis], faces_[i]) <
                              std::pair(key(shapes_[j])[axis], faces_[j]);
                     });
    Reorder(order, first);
    const auto left = static_cast<std::int32_t>(nodes_.size());
    nodes_.emplace_back();
    nodes_.emplace_back();
    nodes_[index].left = left;
    Split(left, first, half);
    Split(left + 1, first + half, count - half);
  }

  void Reorder(const std::vector<std::int32_t>& order, std::int32_t first) {
    std::vector<FaceShape> shapes;
    std::vector<std::int32_t> faces;
    for (const std::int32_t i : order) {
      shapes.push_back(shapes_[i]);
      faces.push_back(faces_[i]);
    }
    std::copy(shapes.begin(), shapes.end(), shapes_.begin() + first);
    std::copy(faces.begin(), faces.end(), faces_.begin() + first);
  }

  AntipodalTest test_;
  double psi_, max_width_;
  std::int32_t leaf_size_;
  std::vector<FaceShape> shapes_;    // in the tree's order
  std::vector<std::int32_t> faces_;  // and their numbers in the mesh
  std::vector<Node> nodes_;
  double place_scale_ = 1.0;
};

}  // namespace

std::vector<FacePair> AntipodalPairs(const TriangleMesh& mesh, const PairLimits& limits) {
  const PairTree tree(mesh, limits);
  std::vector<FacePair> pairs;
  const auto add = [&](std::int32_t i, std::int32_t j) {
    const std::int32_t f = tree.FaceAt(i), g = tree.FaceAt(j);
    pairs.push_back({std::min(f, g), std::max(f, g)});
  };
  const auto add_block = [&](const Node& a, const Node& b) {
    for (std::int32_t i = a.first; i < a.first + a.count; ++i) {
      for (std::int32_t j = b.first; j < b.first + b.count; ++j) add(i, j);
    }
  };
  tree.Visit(add_block, [&](const Node& a, const Node& b) { tree.VisitPairs(a, b, add); });
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

std::int64_t CountAntipodalPairs(const TriangleMesh& mesh, const PairLimits& limits,
                                 std::size_t most_counted) {
  const auto parts = static_cast<std::int32_t>(std::max<std::size_t>(1, most_counted / kLeafSize));
  const auto faces = static_cast<std::int32_t>(mesh.faces.size());
  const bool all = mesh.faces.size() <= most_counted;
  const PairTree tree(mesh, limits, all ? kLeafSize : faces / parts + 1);
  RngStream rng(0, "antipodal pairs");
  std::int64_t count = 0;
  tree.Visit([&](const Node& a, const Node& b) { count += std::int64_t{a.count} * b.count; },
             [&](const Node& a, const Node& b) {
               if (all || a.first == b.first) {
                 tree.VisitPairs(a, b, [&](std::int32_t, std::int32_t) { ++count; });
               } else {
                 count += tree.EstimatePairs(a, b, &rng);
               }
             });
  return count;
}

}  // namespace antigrasp
