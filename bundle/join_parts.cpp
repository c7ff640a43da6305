#include "antigrasp/bundle/join_parts.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "antigrasp/bundle/hull_volume.h"
#include "antigrasp/bundle/small_hull.h"

namespace antigrasp {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr std::size_t kMiddles = 150, kStrideA = 7, kStrideB = 13;
constexpr double kHeld = 1e-6;     // of the size
constexpr double kHopeless = 1.2;  // dents

struct Joint {
  ConvexPart hull;     // empty where it covers too deep a dent
  double depth = 0.0;  // of the deepest dent, then at least
};

// Whether the part is in the other one, but for rounding.
bool Holds(const ConvexPart& part, const ConvexPart& other) {
  const double near = kHeld * part.box.Extent().norm();
  return std::all_of(other.mesh.vertices.begin(), other.mesh.vertices.end(), [&](const auto& v) {
    return std::all_of(part.planes.begin(), part.planes.end(),
                       [&](const HalfSpace& plane) { return plane.Outside(v) <= near; });
  });
}

class Joiner {
 public:
  Joiner(std::vector<ConvexPart> parts, const SurfacePoints& surface, const SolidTest& solid,
         double dent)
      : parts_(std::move(parts)),
        surface_(surface),
        solid_(solid),
        dent_(dent),
        air_(kHopeless * dent) {
    JoinAll();
  }

  // Pairs that are between air are hulls, too, from now on.
  void JoinThroughAir() {
    air_ = kNever;
    JoinAll();
  }
  void JoinAll() {
    joints_.assign(parts_.size(), {});
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) joints_[i].push_back(Join(i, j));
    }
  }

  std::size_t size() const { return parts_.size(); }
  std::vector<ConvexPart> Take() { return std::move(parts_); }

  // Of the pairs whose hull covers no deeper dent than that the largest; else the shallowest one.
  std::pair<std::size_t, std::size_t> Best() const {
    std::pair<std::size_t, std::size_t> best{1, 0};
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const Joint& now = joints_[best.first][best.second];
        const Joint& other = joints_[i][j];
        const bool better = other.depth > dent_ || now.depth > dent_
                                ? other.depth < now.depth
                                : other.hull.volume > now.hull.volume;
        if (better) best = {i, j};
      }
    }
    return best;
  }
  double Depth(std::pair<std::size_t, std::size_t> pair) const {
    return joints_[pair.first][pair.second].depth;
  }

  void JoinPair(std::pair<std::size_t, std::size_t> pair) {
    auto [i, j] = pair;  // j < i
    ConvexPart hull = std::move(joints_[i][j].hull);
    parts_[j] = hull.empty() ? MakeConvexPart(CornersOf(i, j)) : std::move(hull);
    Erase(i);
    for (std::size_t k = parts_.size(); k-- > 0;) {
      if (k != j && Holds(parts_[j], parts_[k])) {
        Erase(k);
        if (k < j) --j;
      }
    }
    for (std::size_t k = 0; k < j; ++k) joints_[j][k] = Join(j, k);
    for (std::size_t k = j + 1; k < parts_.size(); ++k) joints_[k][j] = Join(k, j);
  }

 private:
  void Erase(std::size_t i) {
    parts_.erase(parts_.begin() + static_cast<std::ptrdiff_t>(i));
    joints_.erase(joints_.begin() + static_cast<std::ptrdiff_t>(i));
    for (std::size_t k = i; k < joints_.size(); ++k) {
      joints_[k].erase(joints_[k].begin() + static_cast<std::ptrdiff_t>(i));
    }
  }

  std::vector<Eigen::Vector3d> CornersOf(std::size_t i, std::size_t j) const {
    std::vector<Eigen::Vector3d> points = parts_[i].mesh.vertices;
    points.insert(points.end(), parts_[j].mesh.vertices.begin(), parts_[j].mesh.vertices.end());
    return points;
  }

  // Most pairs are hopeless, and few of their corners show it.
  Joint Join(std::size_t i, std::size_t j) const {
    if (BetweenInAir(parts_[i].mesh.vertices, parts_[j].mesh.vertices)) return {{}, kNever};
    const std::vector<Eigen::Vector3d> points = CornersOf(i, j);
    const double least = DeepestIn(SmallHull(FurthestPoints(points)).Part(), surface_, 0.0).depth;
    if (least > dent_) return {{}, least};
    Joint joint{MakeConvexPart(points), 0.0};
    joint.depth = DeepestIn(joint.hull, surface_, 0.0).depth;
    return joint;
  }

  // Whether some middle between corners of both is far from the solid: what saves most hulls.
  bool BetweenInAir(const std::vector<Eigen::Vector3d>& a,
                    const std::vector<Eigen::Vector3d>& b) const {
    for (std::size_t k = 0; k < kMiddles; ++k) {
      const Eigen::Vector3d& p = a[(k * kStrideA) % a.size()];
      const Eigen::Vector3d& q = b[(k * kStrideB) % b.size()];
      if (solid_.InAir(0.5 * (p + q), air_)) return true;
    }
    return false;
  }

  std::vector<ConvexPart> parts_;
  const SurfacePoints& surface_;
  const SolidTest& solid_;
  double dent_, air_;
  std::vector<std::vector<Joint>> joints_;  // of i and j < i
};

}  // namespace

std::vector<ConvexPart> JoinParts(std::vector<ConvexPart> parts, const SurfacePoints& surface,
                                  const SolidTest& solid, double dent, int most) {
  Joiner joiner(std::move(parts), surface, solid, dent);
  while (joiner.size() > 1) {
    const auto best = joiner.Best();
    if (joiner.Depth(best) > dent && joiner.size() <= static_cast<std::size_t>(most)) break;
    if (joiner.Depth(best) == kNever) {
      joiner.JoinThroughAir();
    } else {
      joiner.JoinPair(best);
    }
  }
  return joiner.Take();
}

}  // namespace antigrasp
