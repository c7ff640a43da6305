#include "antigrasp/bundle/convex_parts.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "antigrasp/bundle/draw_in.h"
#include "antigrasp/bundle/hull_volume.h"
#include "antigrasp/bundle/join_parts.h"
#include "antigrasp/bundle/solid_piece.h"
#include "antigrasp/bundle/solid_test.h"
#include "antigrasp/bundle/surface_points.h"
#include "antigrasp/sdf/sdf_grid.h"

namespace antigrasp {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kEdge = 1.5;         // cells: longest edge of the surface that is cut
constexpr double kNear = 2.5;         // cells: whose faces say how a dent runs
constexpr int kTurns = 8;             // planes through a dent, about its line
constexpr std::size_t kPlaces = 2;    // dents at which a piece may be cut
constexpr double kDeep = 0.6;         // of the deepest
constexpr double kSliver = 1e-4;      // of the volume: less is no piece
constexpr double kUnlike = 0.01;      // what a difference of volumes costs beside volume
constexpr double kLess = 1.0 - 1e-9;  // sums over hulls differ in their last bits from call to call
constexpr double kMorePieces = 1.5;   // than parts, before they are joined

struct Node {
  SolidPiece piece;
  ConvexPart hull;
  DeepPoint deepest;
};

// The directions of a dent: its mean outward normal, the way the surface turns across it, and the
// normals of its two walls.
struct DentFrame {
  Vector3d out = Vector3d::UnitX(), across = Vector3d::UnitY();
  Vector3d wall1 = Vector3d::UnitX(), wall2 = Vector3d::UnitX();
};

DentFrame FrameAt(const Vector3d& place, const SurfacePoints& surface, double radius) {
  DentFrame frame;
  std::vector<const Vector3d*> near;
  Vector3d sum = Vector3d::Zero();
  for (std::size_t i = 0; i < surface.middles.size(); ++i) {
    if ((surface.middles[i] - place).squaredNorm() > radius * radius) continue;
    near.push_back(&surface.crosses[i]);
    sum += surface.crosses[i];
  }
  if (!(sum.norm() > 0.0)) return frame;
  frame.out = sum.normalized();
  Matrix3d turning = Matrix3d::Zero();
  for (const Vector3d* cross : near) {
    const double weight = cross->norm();
    if (!(weight > 0.0)) continue;
    const Vector3d aside = *cross / weight - frame.out * frame.out.dot(*cross) / weight;
    turning += weight * aside * aside.transpose();
  }
  frame.across = Eigen::SelfAdjointEigenSolver<Matrix3d>(turning).eigenvectors().col(2);
  frame.across -= frame.out * frame.out.dot(frame.across);
  frame.across =
      frame.across.norm() > 1e-9 ? frame.across.normalized() : frame.out.unitOrthogonal();
  Vector3d walls[2] = {Vector3d::Zero(), Vector3d::Zero()};
  for (const Vector3d* cross : near) walls[cross->dot(frame.across) > 0.0 ? 1 : 0] += *cross;
  frame.wall1 = walls[0].norm() > 0.0 ? walls[0].normalized() : frame.out;
  frame.wall2 = walls[1].norm() > 0.0 ? walls[1].normalized() : frame.out;
  return frame;
}

std::vector<HalfSpace> PlanesThrough(const Vector3d& place, const DentFrame& frame) {
  std::vector<Vector3d> normals{frame.wall1, frame.wall2, frame.out.cross(frame.across)};
  for (int k = 0; k < kTurns; ++k) {
    const double turn = std::numbers::pi * k / kTurns;
    normals.push_back(std::cos(turn) * frame.out + std::sin(turn) * frame.across);
  }
  for (int axis = 0; axis < 3; ++axis) normals.push_back(Vector3d::Unit(axis));
  std::vector<HalfSpace> planes;
  for (const Vector3d& normal : normals) planes.push_back({normal, normal.dot(place)});
  return planes;
}

class Cutter {
 public:
  explicit Cutter(const TriangleMesh& solid)
      : cell_(CellOf(solid)),
        fine_(Refined(solid, kEdge * cell_)),
        surface_(PointsOf(fine_)),
        solid_(solid) {}

  std::vector<ConvexPart> Run(const PartOptions& options) {
    const double dent = options.dent * cell_;
    std::vector<Node> nodes;
    nodes.push_back(MakeNode({fine_, {}, {}}));
    std::vector<ConvexPart> done;
    const int most = static_cast<int>(kMorePieces * options.parts);
    while (!nodes.empty()) {
      const auto deepest = std::max_element(
          nodes.begin(), nodes.end(),
          [](const Node& a, const Node& b) { return a.deepest.depth < b.deepest.depth; });
      Node node = std::move(*deepest);
      nodes.erase(deepest);
      const bool cut =
          node.deepest.depth > dent && static_cast<int>(nodes.size() + done.size()) + 2 <= most;
      if (cut && CutNode(node, &nodes)) continue;
      if (!node.hull.empty()) done.push_back(std::move(node.hull));
    }

    std::vector<ConvexPart> joined =
        JoinParts(std::move(done), surface_, solid_, dent, options.parts);
    return options.draw_in > 0.0 ? DrawnIn(std::move(joined), solid_, options.draw_in, cell_)
                                 : joined;
  }

 private:
  Node MakeNode(SolidPiece piece) const {
    Node node{std::move(piece), {}, {}};
    node.hull = MakeConvexPart(HullPoints(node.piece));
    node.deepest = DeepestIn(node.hull, surface_, 0.0);
    return node;
  }

  // By the plane that leaves the least volume of hulls, the more alike the two the better: no
  // single cut makes the hulls of a ring smaller. False when none cuts the piece.
  bool CutNode(const Node& node, std::vector<Node>* nodes) const {
    const InsideTest inside = [&](const Vector3d& point) { return solid_.Inside(point); };
    double least = std::numeric_limits<double>::max();
    HalfSpace best;
    for (const Vector3d& place : DeepPlaces(node.hull, surface_, node.deepest, kDeep, kPlaces)) {
      for (const HalfSpace& plane : PlanesThrough(place, FrameAt(place, surface_, kNear * cell_))) {
        const auto sides = HullPointsOfSides(node.piece, plane, inside);
        const double behind = AboutHullVolume(sides[0]), before = AboutHullVolume(sides[1]);
        const double cost = behind + before + kUnlike * std::abs(behind - before);
        if (!(std::min(behind, before) > kSliver * (behind + before))) continue;
        if (!(cost < kLess * least)) continue;
        least = cost;
        best = plane;
      }
    }
    if (!(least < std::numeric_limits<double>::max())) return false;
    for (SolidPiece& side : Cut(node.piece, best, inside)) {
      nodes->push_back(MakeNode(std::move(side)));
    }
    return true;
  }

  double cell_;
  TriangleMesh fine_;
  SurfacePoints surface_;
  SolidTest solid_;
};

}  // namespace

double CellOf(const TriangleMesh& solid) {
  const SdfGrid grid;
  return Bounds(solid).Extent().maxCoeff() / (grid.n - 2.0 * kFreeCells);
}

std::vector<ConvexPart> ConvexParts(const TriangleMesh& solid, const PartOptions& options) {
  std::vector<ConvexPart> parts = Cutter(solid).Run(options);
  std::stable_sort(parts.begin(), parts.end(),
                   [](const ConvexPart& a, const ConvexPart& b) { return a.volume > b.volume; });
  return parts;
}

}  // namespace antigrasp
