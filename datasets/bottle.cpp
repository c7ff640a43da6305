#include "antigrasp/datasets/bottle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "antigrasp/core/check.h"

namespace antigrasp {
namespace {

using Eigen::Vector2d;

struct Range {
  double low, high;
  double Draw(RngStream& rng) const { return rng.Uniform(low, high); }
};

// Heights are parts of the whole height; what body, shoulder and cap leave is the neck. A cap is at
// least two cells of a 32^3 grid thick: thinner ones come and go with where the nodes lie, and
// generators make rings of specks of them. Radii are
// parts of the body's, but body_radius is one of the cube's side.
struct Family {
  Range height, body_radius;
  Range body, shoulder, cap;
  Range neck_radius;
  Range cap_radius;  // of the neck's radius
  Range waist;       // how much of the radius the middle of the body loses
  Range dimple;      // depth of the hollow base
  Range fillet;      // rounding of the lower edge
};

constexpr std::array<Family, kBottleFamilies> kFamilies = {{
    // wine: straight body, round shoulder, long neck with a lip, deep hollow base
    {{0.93, 1.0},
     {0.145, 0.18},
     {0.50, 0.60},
     {0.12, 0.18},
     {0.075, 0.105},
     {0.36, 0.44},
     {1.12, 1.30},
     {0.0, 0.0},
     {0.03, 0.08},
     {0.08, 0.2}},
    // beer: long slope from the body to the crown cap
    {{0.80, 0.98},
     {0.15, 0.19},
     {0.40, 0.52},
     {0.22, 0.32},
     {0.085, 0.115},
     {0.36, 0.45},
     {1.12, 1.30},
     {0.0, 0.0},
     {0.01, 0.03},
     {0.1, 0.25}},
    // water: waist, screw cap wider than the neck
    {{0.85, 1.0},
     {0.15, 0.19},
     {0.58, 0.68},
     {0.10, 0.18},
     {0.08, 0.115},
     {0.38, 0.50},
     {1.15, 1.40},
     {0.06, 0.22},
     {0.02, 0.05},
     {0.15, 0.4}},
    // flask: cone on a flat base
    {{0.75, 0.95},
     {0.26, 0.36},
     {0.04, 0.10},
     {0.48, 0.60},
     {0.09, 0.13},
     {0.26, 0.38},
     {1.15, 1.40},
     {0.0, 0.0},
     {0.0, 0.02},
     {0.08, 0.15}},
    // jar: wide, lid nearly as wide as the body
    {{0.60, 0.82},
     {0.26, 0.38},
     {0.64, 0.74},
     {0.07, 0.13},
     {0.115, 0.16},
     {0.68, 0.84},
     {1.04, 1.18},
     {0.0, 0.06},
     {0.01, 0.03},
     {0.08, 0.2}},
    // spray: can with a domed shoulder and a nozzle narrower than the neck
    {{0.88, 1.0},
     {0.13, 0.17},
     {0.64, 0.74},
     {0.06, 0.10},
     {0.08, 0.13},
     {0.55, 0.70},
     {0.55, 0.75},
     {0.0, 0.0},
     {0.01, 0.03},
     {0.05, 0.12}},
}};

constexpr Range kCapFillet = {0.3, 0.5};  // rounding of the cap's upper edge, of its height
constexpr int kCurveSteps = 16;
constexpr double kArc = 0.5522847498;  // a cubic this long is a quarter circle to 3e-4

void AddBezier(std::vector<Vector2d>* outline, const Vector2d& a, const Vector2d& b,
               const Vector2d& c, const Vector2d& d) {
  for (int i = 1; i <= kCurveSteps; ++i) {
    const double t = 1.0 * i / kCurveSteps, s = 1.0 - t;
    outline->push_back(s * s * s * a + 3 * s * s * t * b + 3 * s * t * t * c + t * t * t * d);
  }
}

// From upright to upright, as a shoulder: both ends are tangent to z.
void AddShoulder(std::vector<Vector2d>* outline, const Vector2d& to, double pull) {
  const Vector2d from = outline->back();
  const Vector2d up(0.0, pull * (to.y() - from.y()));
  AddBezier(outline, from, from + up, to - up, to);
}

void AddBase(std::vector<Vector2d>* outline, double radius, double dimple, double fillet) {
  const double foot = 0.92 * (radius - fillet);  // where the hollow meets the ground
  outline->push_back({0.0, dimple});
  AddBezier(outline, {0.0, dimple}, {0.5 * foot, dimple}, {0.7 * foot, 0.0}, {foot, 0.0});
  outline->push_back({radius - fillet, 0.0});
  AddBezier(outline, {radius - fillet, 0.0}, {radius - (1 - kArc) * fillet, 0.0},
            {radius, (1 - kArc) * fillet}, {radius, fillet});
}

// From the neck out to the cap's rim, up, and over a rounded edge to the axis.
void AddCap(std::vector<Vector2d>* outline, double radius, double bottom, double top,
            double fillet) {
  outline->push_back({outline->back().x(), bottom});
  outline->push_back({radius, bottom});
  outline->push_back({radius, top - fillet});
  AddBezier(outline, {radius, top - fillet}, {radius, top - (1 - kArc) * fillet},
            {radius - (1 - kArc) * fillet, top}, {radius - fillet, top});
  outline->push_back({0.0, top});
}

// The body's wall, drawn in by a cosine in the middle.
void AddBody(std::vector<Vector2d>* outline, double radius, double top, double waist) {
  const double bottom = outline->back().y();
  for (int i = 1; i <= 2 * kCurveSteps; ++i) {
    const double t = 0.5 * i / kCurveSteps;
    const double in = 0.5 * waist * radius * (1.0 - std::cos(2.0 * std::numbers::pi * t));
    outline->push_back({radius - in, bottom + t * (top - bottom)});
  }
}

double SquaredDistanceToSegment(const Vector2d& p, const Vector2d& a, const Vector2d& b) {
  const Vector2d edge = b - a, from = p - a;
  const double length = edge.squaredNorm();
  const double t = length > 0.0 ? std::clamp(from.dot(edge) / length, 0.0, 1.0) : 0.0;
  return (from - t * edge).squaredNorm();
}

}  // namespace

BottleProfile SampleBottle(int family, RngStream& rng) {
  AG_CHECK(family >= 0 && family < kBottleFamilies, "unknown bottle family");
  const Family& f = kFamilies[static_cast<std::size_t>(family)];
  const double height = f.height.Draw(rng), radius = f.body_radius.Draw(rng);
  const double body_top = f.body.Draw(rng) * height;
  const double shoulder_top = body_top + f.shoulder.Draw(rng) * height;
  const double cap_bottom = height - f.cap.Draw(rng) * height;
  const double neck = f.neck_radius.Draw(rng) * radius;
  const double cap = f.cap_radius.Draw(rng) * neck;
  const double waist = f.waist.Draw(rng), dimple = f.dimple.Draw(rng) * height;
  const double fillet = std::min(f.fillet.Draw(rng) * radius, 0.8 * body_top);
  BottleProfile profile;
  std::vector<Vector2d>& outline = profile.outline;
  AddBase(&outline, radius, dimple, fillet);
  AddBody(&outline, radius, body_top, waist);
  AddShoulder(&outline, {neck, std::min(shoulder_top, cap_bottom)}, rng.Uniform(0.35, 0.65));
  const double cap_fillet = std::min(kCapFillet.Draw(rng) * (height - cap_bottom), 0.5 * cap);
  AddCap(&outline, cap, cap_bottom, height, cap_fillet);
  for (Vector2d& p : outline) p.y() -= 0.5 * height;
  return profile;
}

double SignedDistance(const BottleProfile& profile, double radius, double z) {
  const Vector2d p(radius, z);
  double nearest = std::numeric_limits<double>::infinity();
  bool inside = false;  // parity of the outline's crossings farther out at the same height
  for (std::size_t i = 0; i + 1 < profile.outline.size(); ++i) {
    const Vector2d &a = profile.outline[i], &b = profile.outline[i + 1];
    nearest = std::min(nearest, SquaredDistanceToSegment(p, a, b));
    if ((a.y() > z) == (b.y() > z)) continue;
    if (a.x() + (z - a.y()) / (b.y() - a.y()) * (b.x() - a.x()) > radius) inside = !inside;
  }
  return inside ? std::sqrt(nearest) : -std::sqrt(nearest);
}

}  // namespace antigrasp
