#include "antigrasp/quality/wrench_dual.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace antigrasp {
namespace {

using Eigen::Vector3d;

bool Spans(const std::array<Contact, 2>& contacts, const Vector3d& com, const WrenchModel& model) {
  double sum = com.sum() + model.friction + model.finger_radius + model.torque_scale;
  for (const Contact& c : contacts) sum += c.point.sum() + c.normal.sum() + c.normal_force;
  return std::isfinite(sum) && contacts[0].normal_force > 0.0 && contacts[1].normal_force > 0.0 &&
         model.friction > 0.0 && TorsionLimit(model) > 0.0 && model.torque_scale > 0.0 &&
         (contacts[0].point - contacts[1].point).norm() > 0.0;
}

// Relative slack of the test whether a vertex of C lies within the torsion bounds: a vertex on the
// bound must not be lost to rounding, one just outside changes the norm by as little.
constexpr double kOnBound = 1e-13;

}  // namespace

double WrenchDual::Norm2Over(double y_norm2, double h, double offset) const {
  if (!(std::abs(h) <= (b + e * a) * (1.0 + kOnBound))) return 0.0;
  const double slope = std::max(e, 1e-100);  // e = 0: the second pair of bounds limits h only
  const double upper = std::clamp((h + b) / slope, -a, a) - offset;
  const double lower = std::clamp((h - b) / slope, -a, a) - offset;
  return y_norm2 + std::max(upper * upper, lower * lower) * kernel2;
}

DualPoint DualMap::At(const Vector3d& p1, const Vector3d& p2, double t) const {
  const Vector3d twist = line.cross(p2 - p1);
  const Vector3d y_force = p1 - twist.cross(arm) / length;
  const double shift = y_force.dot(kernel_force) / kernel2;
  const std::size_t other = 1 - base;
  const double base_ratio = inward[base].dot(twist) / along[base];
  DualPoint point;
  point.y << y_force - shift * kernel_force, (twist - shift * line) / (torque_scale * length);
  point.g = (p1 - p2).dot(line);
  point.h = std::abs(along[other]) * base_ratio -
            std::copysign(1.0, along[other]) * inward[other].dot(twist);
  point.offset = base_ratio - shift;
  point.t = t;
  return point;
}

std::optional<DualMap> MakeDualMap(const std::array<Contact, 2>& contacts, const Vector3d& com,
                                   const WrenchModel& model, const TangentFrames& frames) {
  if (!Spans(contacts, com, model)) return std::nullopt;
  DualMap map;
  const Vector3d between = contacts[1].point - contacts[0].point;
  map.length = between.norm();
  map.line = between / map.length;
  map.torque_scale = model.torque_scale;
  map.arm = contacts[0].point - com;
  map.kernel_force = -map.line.cross(map.arm) / map.length;
  const double kernel_torque = 1.0 / (model.torque_scale * map.length);
  map.kernel2 = map.kernel_force.squaredNorm() + kernel_torque * kernel_torque;
  map.frames = frames;
  map.cone_edges = model.cone_edges;
  map.inset = model.friction * std::cos(std::numbers::pi / model.cone_edges);

  std::array<double, 2> bound;  // torsion rows: |d_i . twist + lambda d_i . D| <= bound
  for (std::size_t i = 0; i < 2; ++i) {
    map.inward[i] = -contacts[i].normal;
    map.apex[i] = map.inward[i] / contacts[i].normal_force;
    map.along[i] = map.inward[i].dot(map.line);
    bound[i] = map.length / (TorsionLimit(model) * contacts[i].normal_force);
  }
  map.base = std::abs(map.along[0]) >= std::abs(map.along[1]) ? 0 : 1;
  if (std::abs(map.along[map.base]) < 1e-14) return std::nullopt;  // no torsion about the line
  map.a = bound[map.base] / std::abs(map.along[map.base]);
  map.b = bound[1 - map.base];
  map.e = std::abs(map.along[1 - map.base]);
  return map;
}

WrenchDual MakeWrenchDual(const DualMap& map) {
  WrenchDual dual;
  dual.apex = map.At(map.apex[0], map.apex[1], 1.0);
  const double step = std::numbers::pi / map.cone_edges;
  for (auto& edges : dual.edges) edges.reserve(static_cast<std::size_t>(map.cone_edges));
  for (int j = 0; j < map.cone_edges; ++j) {
    // Polar of the friction pyramid: its edges are the outward normals of the pyramid's sides.
    const double angle = (2 * j + 1) * step;
    const double along1 = std::cos(angle), along2 = std::sin(angle);
    const auto side = [&](std::size_t i) -> Vector3d {
      return along1 * map.frames[i][0] + along2 * map.frames[i][1] - map.inset * map.inward[i];
    };
    dual.edges[0].push_back(map.At(side(0), Vector3d::Zero(), 0.0));
    dual.edges[1].push_back(map.At(Vector3d::Zero(), side(1), 0.0));
  }
  dual.a = map.a;
  dual.b = map.b;
  dual.e = map.e;
  dual.kernel2 = map.kernel2;
  return dual;
}

}  // namespace antigrasp
