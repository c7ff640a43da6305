#include "antigrasp/perturb/polyhedra.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "antigrasp/core/angles.h"
#include "antigrasp/core/check.h"
#include "antigrasp/core/rng.h"
#include "antigrasp/mesh/convex_hull.h"

namespace antigrasp {
namespace {

using Corners = std::vector<Eigen::Vector3d>;
using Eigen::Vector3d;

constexpr double kReachedSlack = 1e-4;     // degrees; what single precision leaves of an angle
constexpr double kBestPyramidCube = 30.0;  // degrees, where phi = 90 - 2 phi
constexpr double kTargetMargin = 1e-3;  // degrees; searched beyond phi, so that rounding keeps phi

std::vector<Vector3d> UnitNormals(const TriangleMesh& mesh) {
  std::vector<Vector3d> normals(mesh.faces.size());
  for (std::size_t f = 0; f < normals.size(); ++f)
    normals[f] = FaceCross(mesh, f).stableNormalized();
  return normals;
}

// Adds what comes from `v` by even permutations of its coordinates and any signs, once each.
void AddEvenPermutations(const Vector3d& v, Corners* corners) {
  for (int turn = 0; turn < 3; ++turn) {
    for (int signs = 0; signs < 8; ++signs) {
      Vector3d corner;
      for (int k = 0; k < 3; ++k) corner[k] = v[(k + turn) % 3] * ((signs >> k & 1) != 0 ? -1 : 1);
      if (std::find(corners->begin(), corners->end(), corner) == corners->end()) {
        corners->push_back(corner);
      }
    }
  }
}

// Inscribed in the cube [-1, 1]^3.
Corners UnitCorners(Polyhedron kind) {
  const double golden = 0.5 * (1.0 + std::sqrt(5.0));
  Corners corners;
  switch (kind) {
    case Polyhedron::kCube:
      AddEvenPermutations({1, 1, 1}, &corners);
      break;
    case Polyhedron::kTetrahedron:
      corners = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
      break;
    case Polyhedron::kOctahedron:
      AddEvenPermutations({1, 0, 0}, &corners);
      break;
    case Polyhedron::kCuboctahedron:
      AddEvenPermutations({1, 1, 0}, &corners);
      break;
    case Polyhedron::kDodecahedron:
      AddEvenPermutations({1, 2 - golden, 0}, &corners);
      AddEvenPermutations(Vector3d::Constant(golden - 1), &corners);
      break;
    case Polyhedron::kIcosahedron:
      AddEvenPermutations({1, golden - 1, 0}, &corners);
      break;
  }
  return corners;
}

TriangleMesh InFloat(TriangleMesh mesh) {
  for (Vector3d& v : mesh.vertices) v = v.cast<float>().cast<double>();
  return mesh;
}

// The paper's adversarial cube over [-1, 1]^3: the middle of the faces at +x, +y and +z moved out
// by tan(phi) / 2 edges.
TriangleMesh PyramidCube(double phi_degrees) {
  TriangleMesh cube;
  for (int i = 0; i < 8; ++i) {
    cube.vertices.emplace_back(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
  }
  const double height = std::tan(phi_degrees * kDegree);  // half of the edge 2
  // The sides at -x, -y, -z, then at +x, +y, +z, counter-clockwise from outside.
  const std::array<std::int32_t, 4> sides[] = {{0, 4, 6, 2}, {0, 1, 5, 4}, {0, 2, 3, 1},
                                               {1, 3, 7, 5}, {2, 6, 7, 3}, {4, 5, 7, 6}};
  for (std::size_t s = 0; s < 6; ++s) {
    const auto& side = sides[s];
    if (s < 3 || !(height > 0.0)) {
      cube.faces.push_back({side[0], side[1], side[2]});
      cube.faces.push_back({side[0], side[2], side[3]});
      continue;
    }
    const auto apex = static_cast<std::int32_t>(cube.vertices.size());
    cube.vertices.push_back((1.0 + height) * Vector3d::Unit(static_cast<Eigen::Index>(s - 3)));
    for (std::size_t k = 0; k < 4; ++k) cube.faces.push_back({side[k], side[(k + 1) % 4], apex});
  }
  return cube;
}

// One search: corners of a convex solid over [-1, 1]^3 on their way to `phi`.
class Search {
 public:
  Search(const Corners& start, double phi, std::uint64_t seed, std::uint64_t number)
      : start_(start), corners_(start), phi_(phi), rng_(seed, "polyhedron", number) {
    violation_ = *Violation(corners_);
  }

  // `moves` trials under weight w; infinity puts phi before everything.
  void Round(std::int64_t moves, double w) {
    for (std::int64_t i = 0; i < moves; ++i) TryMove(w);
  }

  double violation() const { return violation_; }
  double displacement() const { return displacement_; }
  const Corners& corners() const { return corners_; }

 private:
  // Sum over pairs of faces of max(0, phi - phi_ij)^2; nullopt when a corner is not on the hull.
  std::optional<double> Violation(const Corners& corners) const {
    const TriangleMesh hull = ConvexHull(corners);
    if (hull.vertices.size() != corners.size()) return std::nullopt;
    const std::vector<Vector3d> normals = UnitNormals(hull);
    const double limit = std::cos(phi_);
    double sum = 0.0;
    for (std::size_t i = 0; i < normals.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const double cosine = -normals[i].dot(normals[j]);
        if (!(cosine > limit)) continue;
        const double missing = phi_ - std::acos(std::min(cosine, 1.0));
        sum += missing * missing;
      }
    }
    return sum;
  }

  void TryMove(double w) {
    const std::size_t k = rng_.Below(corners_.size());
    const double length = 0.15 * std::pow(10.0, -3.0 * rng_.Uniform());
    Vector3d move;
    for (int axis = 0; axis < 3; ++axis) move[axis] = length * rng_.Normal();
    const Vector3d before = corners_[k];
    corners_[k] += move;
    const double displacement = displacement_ - (before - start_[k]).squaredNorm() +
                                (corners_[k] - start_[k]).squaredNorm();
    const std::optional<double> violation = Violation(corners_);
    if (violation && Better(*violation, displacement, w)) {
      violation_ = *violation;
      displacement_ = displacement;
    } else {
      corners_[k] = before;
    }
  }

  bool Better(double violation, double displacement, double w) const {
    if (std::isfinite(w)) {
      return displacement + w * violation < displacement_ + w * violation_;
    }
    if (violation != violation_) return violation < violation_;
    return displacement < displacement_;
  }

  Corners start_, corners_;
  double phi_;
  RngStream rng_;
  double violation_ = 0.0;
  double displacement_ = 0.0;  // sum of squares
};

// Far from phi the least violation counts, then the least displacement.
bool Ahead(const Search& a, const Search& b) {
  if (a.violation() != b.violation()) return a.violation() < b.violation();
  return a.displacement() < b.displacement();
}

Corners FindCorners(const Corners& start, const PolyhedronOptions& options, int threads,
                    const ProgressFn& progress) {
  constexpr double kFirst = std::numeric_limits<double>::infinity();
  const std::vector<double> weights{1, 3, 10, 30, 100, 300, 1000, kFirst, kFirst, kFirst};
  const auto moves = static_cast<std::int64_t>(options.moves) * std::ssize(start);
  std::vector<Search> searches;
  for (int i = 0; i < options.restarts; ++i) {
    searches.emplace_back(start, (options.phi + kTargetMargin) * kDegree, options.seed,
                          static_cast<std::uint64_t>(i));
  }
  for (std::size_t round = 0; round < weights.size(); ++round) {
    ParallelFor(options.restarts, threads, [&](std::int64_t i) {
      searches[static_cast<std::size_t>(i)].Round(moves, weights[round]);
    });
    if (progress) progress(static_cast<std::int64_t>(round) + 1, std::ssize(weights));
  }
  return std::min_element(searches.begin(), searches.end(), Ahead)->corners();
}

void MeasureMoves(const Corners& start, const Corners& corners, AdversarialPolyhedron* result) {
  double squares = 0.0;
  for (std::size_t i = 0; i < start.size(); ++i) {
    const double move = 0.5 * (corners[i] - start[i]).norm();  // over [-1, 1]^3
    result->largest_move = std::max(result->largest_move, move);
    squares += move * move;
  }
  result->rms_move = std::sqrt(squares / static_cast<double>(start.size()));
}

}  // namespace

Antipodality SmallestAntipodality(const TriangleMesh& mesh) {
  const std::vector<Vector3d> normals = UnitNormals(mesh);
  Antipodality smallest;
  for (std::size_t i = 0; i < normals.size(); ++i) {
    for (std::size_t j = i + 1; j < normals.size(); ++j) {
      if (normals[i].isZero(0.0) || normals[j].isZero(0.0)) continue;
      const double degrees =
          std::atan2(normals[i].cross(normals[j]).norm(), -normals[i].dot(normals[j])) / kDegree;
      if (degrees < smallest.degrees) smallest = {degrees, i, j};
    }
  }
  return smallest;
}

bool IsConvex(const TriangleMesh& mesh) {
  const double slack = 1e-6 * Bounds(mesh).Extent().norm();
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const Vector3d normal = FaceCross(mesh, f).stableNormalized();
    const Vector3d& corner = mesh.vertices[static_cast<std::size_t>(mesh.faces[f][0])];
    for (const Vector3d& v : mesh.vertices) {
      if (normal.dot(v - corner) > slack) return false;
    }
  }
  return true;
}

TriangleMesh PlainPolyhedron(Polyhedron kind, double size) {
  const TriangleMesh unit =
      kind == Polyhedron::kCube ? PyramidCube(0.0) : ConvexHull(UnitCorners(kind));
  return Transformed(unit, 0.5 * size, Vector3d::Zero());
}

void Bind(OptionTable* table, PolyhedronOptions* options) {
  table->Add("shape.restarts", &options->restarts, 1, 1000,
             "searches; the one that moves the corners least wins");
  table->Add("shape.moves", &options->moves, 1, 1e6,
             "moves tried per corner in each of the ten rounds of a search");
}

AdversarialPolyhedron MakeAdversarialPolyhedron(Polyhedron kind, const PolyhedronOptions& options,
                                                int threads, const ProgressFn& progress) {
  AG_CHECK(options.phi >= 0.0 && options.phi < 90.0 && options.size > 0.0 && options.restarts > 0,
           "phi in [0, 90), size and number of searches positive");
  AdversarialPolyhedron result;
  const auto take = [&](const TriangleMesh& mesh) {
    result.mesh = InFloat(mesh);
    result.antipodality = SmallestAntipodality(result.mesh);
    result.reached = result.antipodality.degrees >= options.phi - kReachedSlack;
  };
  take(PlainPolyhedron(kind, options.size));
  if (result.reached) return result;
  if (kind == Polyhedron::kCube) {
    const double phi = std::min(options.phi, kBestPyramidCube);
    take(Transformed(PyramidCube(phi), 0.5 * options.size, Vector3d::Zero()));
    result.largest_move = 0.5 * std::tan(phi * kDegree);
    result.rms_move = result.largest_move * std::sqrt(3.0 / 11.0);  // three of eleven vertices
    return result;
  }
  const Corners start = UnitCorners(kind);
  const Corners corners = FindCorners(start, options, threads, progress);
  take(Transformed(ConvexHull(corners), 0.5 * options.size, Vector3d::Zero()));
  MeasureMoves(start, corners, &result);
  return result;
}

}  // namespace antigrasp
