#include "antigrasp/contact/mesh_contact.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <mutex>
#include <numbers>
#include <tuple>

#include "antigrasp/contact/box_triangle.h"
#include "antigrasp/contact/contact_patch.h"
#include "antigrasp/contact/pad_clip.h"
#include "antigrasp/contact/pad_distance.h"
#include "antigrasp/contact/surface_features.h"
#include "antigrasp/contact/triangle_tree.h"
#include "antigrasp/mesh/convex_hull.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Two normals nearer to each other than 8 degrees are one contact: the facets of a smooth surface
// would be many.
const double kOneContact = std::cos(8.0 * std::numbers::pi / 180.0);

// Of a pad's, where anything has come in through its sides.
constexpr int kSideContacts = 2;

// Local minima that a query looks at, nearest ones; a sphere in a bowl of its own radius has many.
constexpr int kMostMinima = 64;

bool Nearer(const Foot& a, const Foot& b) {
  return std::tie(a.square, a.point.x(), a.point.y(), a.point.z()) <
         std::tie(b.square, b.point.x(), b.point.y(), b.point.z());
}

// The nearest feet, sorted.
class Feet {
 public:
  void Add(const Foot& foot) {
    if (size_ == kMostMinima && !Nearer(foot, feet_[size_ - 1])) return;
    int at = size_ < kMostMinima ? size_++ : size_ - 1;
    for (; at > 0 && Nearer(foot, feet_[at - 1]); --at) feet_[at] = feet_[at - 1];
    feet_[at] = foot;
  }
  const Foot* begin() const { return feet_.data(); }
  const Foot* end() const { return feet_.data() + size_; }

 private:
  std::array<Foot, kMostMinima> feet_;
  int size_ = 0;
};

// Corners of the convex hull, sorted: CGAL's order follows from addresses.
std::vector<Vector3d> HullCorners(const TriangleMesh& mesh) {
  std::vector<Vector3d> corners = ConvexHull(mesh.vertices).vertices;
  if (corners.empty()) corners = mesh.vertices;  // flat
  std::sort(corners.begin(), corners.end(), [](const Vector3d& a, const Vector3d& b) {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
  });
  return corners;
}

SurfaceContact SphereContact(const SpherePose& sphere, const Foot& foot, bool inside,
                             const Vector3d& outward) {
  const double length = std::sqrt(foot.square);
  SurfaceContact contact;
  contact.normal = length > 0.0 ? Vector3d(foot.away / (inside ? -length : length)) : outward;
  contact.distance = (inside ? -length : length) - sphere.radius;
  contact.position = foot.point + 0.5 * contact.distance * contact.normal;
  return contact;
}

// The box in front of a pad and around it where a surface is touched, as a box with the pad's axes.
PadPose FrontRegion(const PadPose& pad, double margin) {
  PadPose region = pad;
  region.center += 0.5 * margin * pad.axes.col(0);
  region.half[0] += 0.5 * margin;
  return region;
}

bool Contains(const PadPose& outer, const PadPose& inner) {
  const Eigen::Matrix3d turn = outer.axes.transpose() * inner.axes;
  const Vector3d offset = outer.axes.transpose() * (inner.center - outer.center);
  const Vector3d reach = offset.cwiseAbs() + turn.cwiseAbs() * inner.half;
  return (reach.array() <= outer.half.array()).all();
}

}  // namespace

struct ContactSolid::Impl {
  explicit Impl(const TriangleMesh& solid)
      : mesh(solid), features(solid), tree(solid, features.faces()) {}

  TriangleMesh mesh;
  SurfaceFeatures features;
  TriangleTree tree;

  // Of tables alone, and half the cost of a solid: made when one asks first.
  const std::vector<Vector3d>& Hull() const {
    std::call_once(hull_made_, [this] { hull_ = HullCorners(mesh); });
    return hull_;
  }

  std::array<Vector3d, 3> Corners(std::int32_t face) const {
    return {features.corner(face, 0), features.corner(face, 1), features.corner(face, 2)};
  }

  // Nearest foot of all; its square is infinite beyond the reach.
  Foot NearestFoot(const Vector3d& place, double reach) const {
    Foot best{};
    best.square = kInfinity;
    double limit = reach;
    tree.Search(TriangleTree::PointProbe(place), reach, [&](std::int32_t face) {
      const Foot foot = features.Nearest(face, place);
      if (Nearer(foot, best) && foot.square <= reach * reach) {
        best = foot;
        limit = std::sqrt(foot.square);
      }
      return limit;
    });
    return best;
  }

  // The foot is the nearest of all.
  bool LooksFromInside(const Foot& foot) const {
    return features.OutwardNormal(foot).dot(foot.away) < 0.0;
  }

  bool IsInside(const Vector3d& place) const {
    if ((place.array() < tree.low().array()).any() || (place.array() > tree.high().array()).any())
      return false;
    return LooksFromInside(NearestFoot(place, kInfinity));
  }

  // Adds the local minima that this face speaks for.
  void AddMinimum(std::int32_t face, const Vector3d& place, double reach, Feet* feet) const {
    const Foot foot = features.Nearest(face, place);
    if (foot.square <= reach * reach && features.Speaks(face, foot) &&
        features.IsLocalMinimum(foot)) {
      feet->Add(foot);
    }
  }

  void Fill(const SpherePose& sphere, double reach, TouchCache* cache) const {
    cache->reach = reach + cache->slack;
    cache->region.center = sphere.center;
    cache->faces.clear();
    const double square = cache->reach * cache->reach;
    tree.Search(TriangleTree::PointProbe(sphere.center), cache->reach, [&](std::int32_t face) {
      if (features.Nearest(face, sphere.center).square <= square) cache->faces.push_back(face);
      return cache->reach;
    });
  }

  void Fill(const PadPose& region, TouchCache* cache) const {
    cache->reach = 0.0;
    cache->region = region;
    cache->region.half.array() += cache->slack;
    cache->faces.clear();
    ForFacesIn(cache->region, [&](std::int32_t face) { cache->faces.push_back(face); });
  }

  template <typename Visit>
  void ForFacesIn(const PadPose& box, const Visit& visit) const {
    tree.Search(TriangleTree::BoxProbe(box), 0.0, [&](std::int32_t face) {
      if (BoxMeetsTriangle(box.half, InPadFrame(box, Corners(face)))) visit(face);
      return 0.0;
    });
  }

 private:
  mutable std::once_flag hull_made_;
  mutable std::vector<Vector3d> hull_;
};

ContactSolid::ContactSolid(const TriangleMesh& mesh) : impl_(std::make_unique<const Impl>(mesh)) {}
ContactSolid::~ContactSolid() = default;
ContactSolid::ContactSolid(ContactSolid&&) noexcept = default;
ContactSolid& ContactSolid::operator=(ContactSolid&&) noexcept = default;

int ContactSolid::Touch(const SpherePose& sphere, double margin, SurfaceContact* out, int most,
                        TouchCache* cache) const {
  const double reach = sphere.radius + margin;
  Feet feet;
  if (cache == nullptr) {
    impl_->tree.Search(TriangleTree::PointProbe(sphere.center), reach, [&](std::int32_t face) {
      impl_->AddMinimum(face, sphere.center, reach, &feet);
      return reach;
    });
  } else {
    const double moved = (sphere.center - cache->region.center).norm();
    if (!(moved + reach <= cache->reach)) impl_->Fill(sphere, reach, cache);
    for (const std::int32_t face : cache->faces) {
      impl_->AddMinimum(face, sphere.center, reach, &feet);
    }
  }
  if (feet.begin() == feet.end()) return 0;
  const bool inside = impl_->LooksFromInside(*feet.begin());
  int count = 0;
  for (const Foot& foot : feet) {
    if (count == most) break;
    if (impl_->LooksFromInside(foot) != inside) continue;
    const SurfaceContact contact =
        SphereContact(sphere, foot, inside, impl_->features.OutwardNormal(foot));
    const bool seen = std::any_of(out, out + count, [&](const SurfaceContact& other) {
      return other.normal.dot(contact.normal) > kOneContact;
    });
    if (!seen) out[count++] = contact;
  }
  return count;
}

int ContactSolid::Touch(const PadPose& pad, double margin, SurfaceContact* out, int most,
                        TouchCache* cache, bool exact_load) const {
  std::vector<PatchPoint> points;
  const auto add = [&](std::int32_t face) {
    AddPadContacts(pad, margin, impl_->Corners(face), impl_->features.normal(face), exact_load,
                   &points);
  };
  const PadPose region = FrontRegion(pad, margin);
  if (cache == nullptr) {
    impl_->tree.Search(TriangleTree::BoxProbe(region), 0.0, [&](std::int32_t face) {
      add(face);
      return 0.0;
    });
  } else {
    if (cache->reach < 0.0 || !Contains(cache->region, region)) impl_->Fill(region, cache);
    for (const std::int32_t face : cache->faces) add(face);
  }
  const auto side = std::stable_partition(points.begin(), points.end(),
                                          [](const PatchPoint& point) { return point.x == 0.0; });
  std::vector<PatchPoint> of_sides(side, points.end());
  points.erase(side, points.end());
  const int for_sides = of_sides.empty() ? 0 : std::min(kSideContacts, most - 1);
  int count = 0;
  for (const PatchPoint& point : PatchCorners(std::move(points), most - for_sides, exact_load)) {
    out[count++] = PadContact(pad, point);
  }
  for (const PatchPoint& point : PatchCorners(std::move(of_sides), for_sides, exact_load)) {
    out[count++] = PadContact(pad, point);
  }
  return count;
}

int ContactSolid::TouchPlane(const Vector3d& normal, double offset, double margin,
                             SurfaceContact* out, int most) const {
  const Vector3d y = normal.unitOrthogonal();
  const Vector3d z = normal.cross(y);
  std::vector<PatchPoint> points;
  for (const Vector3d& corner : impl_->Hull()) {
    const double height = normal.dot(corner) - offset;
    if (height > margin) continue;
    points.push_back({{y.dot(corner), z.dot(corner)}, Vector3d::UnitX(), height});
  }
  int count = 0;
  for (const auto& [place, up, height, lowest, x] : PatchCorners(std::move(points), most)) {
    const Vector3d middle = place[0] * y + place[1] * z + (offset + 0.5 * height) * normal;
    out[count++] = {middle, normal, height};
  }
  return count;
}

double ContactSolid::Distance(const SpherePose& sphere, double limit) const {
  const Foot foot = impl_->NearestFoot(sphere.center, std::max(0.0, sphere.radius + limit));
  if (foot.square < kInfinity) {
    const double length = std::sqrt(foot.square);
    return (impl_->LooksFromInside(foot) ? -length : length) - sphere.radius;
  }
  if (!impl_->IsInside(sphere.center)) return kInfinity;
  return -std::sqrt(impl_->NearestFoot(sphere.center, kInfinity).square) - sphere.radius;
}

double ContactSolid::Distance(const PadPose& pad, double limit) const {
  double best = kInfinity;
  double reach = std::max(0.0, limit);
  impl_->tree.Search(TriangleTree::BoxProbe(pad), reach, [&](std::int32_t face) {
    const double gap = PadGap(pad, InPadFrame(pad, impl_->Corners(face)));
    if (gap <= reach) best = reach = gap;
    return reach;
  });
  if (best > 0.0 && impl_->IsInside(pad.center)) return 0.0;
  return best;
}

bool ContactSolid::Overlaps(const SpherePose& sphere) const {
  return impl_->NearestFoot(sphere.center, sphere.radius).square < kInfinity ||
         impl_->IsInside(sphere.center);
}

bool ContactSolid::Overlaps(const PadPose& pad) const {
  bool meets = false;
  impl_->ForFacesIn(pad, [&](std::int32_t) { meets = true; });
  return meets || impl_->IsInside(pad.center);
}

}  // namespace antigrasp
