#include "antigrasp/quality/tip_quality.h"

#include <algorithm>

#include "antigrasp/quality/epsilon.h"
#include "antigrasp/quality/robust_quality.h"

namespace antigrasp {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr double kPointRadius = 1e-4;  // m, of a point that settles
constexpr double kTouch = 1e-6;        // m: a tip that is nearer touches

Fingertip TipOf(const MetricOptions& options) {
  Fingertip tip;
  tip.shape = options.contact == TipContact::kPad ? TipShape::kPad : TipShape::kSphere;
  tip.radius = options.contact == TipContact::kPoint ? kPointRadius : options.ball_radius;
  tip.patch_radius = options.finger_radius;
  tip.pad_width = options.patch_width;
  tip.pad_height = options.patch_height;
  return tip;
}

double RadiusAbout(const TriangleMesh& mesh, const Vector3d& com) {
  double square = 0.0;
  for (const Vector3d& vertex : mesh.vertices)
    square = std::max(square, (vertex - com).squaredNorm());
  return std::sqrt(square);
}

}  // namespace

bool TipQuality::Judges(const MetricOptions& options) {
  return options.contact != TipContact::kPoint || options.closing != ClosingEnd::kFirst;
}

TipQuality::TipQuality(const GraspObject& object, const MetricOptions& options)
    : com_(object.com),
      options_(options),
      tip_(TipOf(options)),
      solid_(object.mesh),
      settling_(object.com, RadiusAbout(object.mesh, object.com), tip_,
                {options.held_mass, options.grip_force}) {}

double TipQuality::Executed(const Grasp& grasp, const NoiseDraw& noise) const {
  if (options_.closing == ClosingEnd::kSettled) {
    const Isometry3d frame = GripperFrame(grasp, ExecutedPose(grasp, com_, noise));
    const Isometry3d object = frame.inverse();
    return settling_.Close(solid_, object, options_.jaw_opening, noise.friction).held ? 1.0 : 0.0;
  }
  const auto contacts = FirstContacts(grasp, noise);
  return contacts ? Epsilon(*contacts, com_, WrenchModelOf(options_, noise.friction)) : 0.0;
}

std::optional<std::array<Contact, 2>> TipQuality::FirstContacts(const Grasp& grasp,
                                                                const NoiseDraw& noise) const {
  const Isometry3d frame = GripperFrame(grasp, ExecutedPose(grasp, com_, noise));
  std::array<Contact, 2> contacts;
  for (std::size_t i = 0; i < 2; ++i) {
    const double side = i == 0 ? 1.0 : -1.0;
    const Vector3d closing = side * frame.linear().col(0);
    const std::optional<Contact> touched = Touch(frame, side);
    if (!touched || Slips(-touched->normal, closing, noise.friction)) return std::nullopt;
    contacts[i] = *touched;
    contacts[i].normal_force = std::max(-closing.dot(touched->normal), 0.0);
  }
  return contacts;
}

std::optional<Contact> TipQuality::Touch(const Isometry3d& frame, double side) const {
  const double thick = tip_.Half().x();
  const auto center = [&](double travel) {
    return Vector3d(-side * (0.5 * options_.jaw_opening + thick - travel), 0.0, 0.0);
  };
  const bool ball = tip_.shape == TipShape::kSphere;
  const double most = 0.5 * options_.jaw_opening;
  for (double travel = 0.0; travel < most;) {
    const SpherePose sphere{frame * center(travel), tip_.radius};
    const PadPose pad = PadAt(tip_, frame, center(travel), side);
    const double clear =
        ball ? solid_.Distance(sphere, most - travel) : solid_.Distance(pad, most - travel);
    if (travel == 0.0 && clear <= 0.0) return std::nullopt;  // starts inside
    if (clear > kTouch) {
      travel += clear;
      continue;
    }
    std::array<SurfaceContact, kMostContacts> found;
    const double margin = 10.0 * kTouch;
    const int count = ball ? solid_.Touch(sphere, margin, found.data(), 1)
                           : solid_.Touch(pad, margin, found.data(), kMostContacts);
    if (count == 0) return std::nullopt;
    Contact contact;
    Vector3d normal = Vector3d::Zero();
    for (int k = 0; k < count; ++k) {
      contact.point += (found[k].position - 0.5 * found[k].distance * found[k].normal) / count;
      normal += found[k].normal;
    }
    contact.normal = normal.normalized();
    return contact;
  }
  return std::nullopt;
}

}  // namespace antigrasp
