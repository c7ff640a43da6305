#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include <Eigen/Geometry>
#include <array>
#include <vector>

#include "antigrasp/contact/mesh_contact.h"
#include "antigrasp/contact/surface_features.h"
#include "bench/compare.h"
#include "bench/timing.h"
#include "tests/support/random_draws.h"
#include "tests/support/rippled_solid.h"

namespace antigrasp::bench {
namespace {

using Eigen::Vector3d;
using Kernel = CGAL::Simple_cartesian<double>;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

constexpr int kRounds = 5, kPoses = 50, kSteps = 200;
constexpr double kContactMargin = 0.2e-3, kBallRadius = 0.005;

Triangles TrianglesOf(const TriangleMesh& mesh) {
  const auto at = [&](std::int32_t v) {
    const Vector3d& p = mesh.vertices[v];
    return Kernel::Point_3(p.x(), p.y(), p.z());
  };
  Triangles triangles;
  for (const auto& [a, b, c] : mesh.faces) triangles.emplace_back(at(a), at(b), at(c));
  return triangles;
}

// Balls that rest on the solid, 20 um deep.
std::vector<SpherePose> RestingBalls(const ContactSolid& solid) {
  RngStream rng(1, "bench-contacts");
  std::vector<SpherePose> balls;
  for (int i = 0; i < kPoses; ++i) {
    const Vector3d out = DrawDirection(&rng);
    SpherePose ball{0.05 * out, kBallRadius};
    for (int step = 0; step < 20; ++step) ball.center -= (solid.Distance(ball, 1.0) + 2e-5) * out;
    balls.push_back(ball);
  }
  return balls;
}

}  // namespace

// A fingertip at rest, as a simulation asks again and again: a ball and a pad of 20 mm on a solid
// of 3,480 faces of 40 mm, against every face, and against CGAL's tree of boxes, which gives the
// nearest point alone.
void CompareContacts() {
  TriangleMesh mesh = RippledSolid(30);
  mesh = Transformed(mesh, 0.04 / Bounds(mesh).Extent().maxCoeff(), Vector3d::Zero());
  const ContactSolid solid(mesh);
  const SurfaceFeatures features(mesh);
  const Triangles triangles = TrianglesOf(mesh);
  Tree tree(triangles.begin(), triangles.end());
  tree.build();
  tree.accelerate_distance_queries();
  const std::vector<SpherePose> balls = RestingBalls(solid);
  std::array<SurfaceContact, kMostContacts> out;
  static double sink = 0.0;
  const auto touch_balls = [&](bool cached) {
    for (const SpherePose& ball : balls) {
      TouchCache cache;
      for (int step = 0; step < kSteps; ++step) {
        sink += solid.Touch(ball, kContactMargin, out.data(), 4, cached ? &cache : nullptr);
      }
    }
  };
  const auto touch_pads = [&](bool cached) {
    for (const SpherePose& ball : balls) {
      PadPose pad{ball.center, Eigen::Matrix3d::Identity(), {0.002, 0.01, 0.01}};
      pad.axes = Eigen::Quaterniond::FromTwoVectors(-Vector3d::UnitX(), ball.center.normalized());
      pad.center -= (kBallRadius - pad.half[0]) * ball.center.normalized();
      TouchCache cache;
      for (int step = 0; step < kSteps / 10; ++step) {
        sink +=
            solid.Touch(pad, kContactMargin, out.data(), kMostContacts, cached ? &cache : nullptr);
      }
    }
  };
  const double asked = kPoses * kSteps;
  const std::vector<double> seconds =
      MedianSeconds({{"ball", [&] { touch_balls(false); }, asked},
                     {"ball, cached", [&] { touch_balls(true); }, asked},
                     {"pad", [&] { touch_pads(false); }, asked / 10},
                     {"pad, cached", [&] { touch_pads(true); }, asked / 10},
                     {"every face",
                      [&] {
                        for (const SpherePose& ball : balls) {
                          for (std::int32_t face : features.faces()) {
                            sink += features.Nearest(face, ball.center).square;
                          }
                        }
                      },
                      kPoses},
                     {"CGAL's nearest point",
                      [&] {
                        for (const SpherePose& ball : balls) {
                          const Vector3d& c = ball.center;
                          for (int step = 0; step < kSteps; ++step) {
                            sink += tree.closest_point({c.x(), c.y(), c.z()}).x();
                          }
                        }
                      },
                      asked}},
                    kRounds);
  PrintTime("contact_ball", seconds[0]);
  PrintTime("contact_ball_cached", seconds[1]);
  PrintTime("contact_pad", seconds[2]);
  PrintTime("contact_pad_cached", seconds[3]);
  PrintRatio("contact_ball_vs_every_face", seconds[4] / seconds[0]);
  PrintRatio("contact_ball_vs_cgal_nearest_point", seconds[5] / seconds[0]);
}

}  // namespace antigrasp::bench
