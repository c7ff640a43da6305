#include "antigrasp/quality/jaw_closing.h"

#include <algorithm>
#include <vector>

namespace antigrasp {
namespace {

using Eigen::Vector3d;

// A jaw's way, at most to the middle.
Ray WayOf(std::size_t jaw, const Vector3d& center, const Vector3d& axis, double opening) {
  const Vector3d closing = jaw == 0 ? axis : Vector3d(-axis);
  return {center - 0.5 * opening * closing, closing, 0.5 * opening};
}

// What stops the jaw, unless it starts inside or slips there.
bool Stops(const std::optional<RayHit>& hit, const Vector3d& closing, double friction,
           Contact* contact) {
  if (!hit || !hit->front || Slips(-hit->normal, closing, friction)) return false;
  *contact = {hit->point, hit->normal, std::max(-closing.dot(hit->normal), 0.0)};
  return true;
}

template <typename Cast>
std::optional<std::array<Contact, 2>> Close(const Vector3d& center, const Vector3d& axis,
                                            double opening, double friction, const Cast& cast) {
  std::array<Contact, 2> contacts;
  for (std::size_t jaw = 0; jaw < 2; ++jaw) {
    const Ray way = WayOf(jaw, center, axis, opening);
    if (!Stops(cast(way), way.direction, friction, &contacts[jaw])) return std::nullopt;
  }
  return contacts;
}

}  // namespace

std::optional<std::array<Contact, 2>> CloseJaws(const RayScene& scene, const Vector3d& center,
                                                const Vector3d& axis, double opening,
                                                double friction) {
  return Close(center, axis, opening, friction, [&](const Ray& way) {
    return scene.Closest(way.origin, way.direction, way.length);
  });
}

std::optional<std::array<Contact, 2>> CloseJaws(const RayScene& scene, const NearFaces& near,
                                                const Vector3d& center, const Vector3d& axis,
                                                double opening, double friction) {
  return Close(center, axis, opening, friction,
               [&](const Ray& way) { return scene.Closest(way, near); });
}

void CloseJawsTogether(const RayScene& scene, std::span<const JawClosing> closings, double opening,
                       std::span<std::optional<std::array<Contact, 2>>> contacts) {
  std::fill(contacts.begin(), contacts.end(), std::array<Contact, 2>{});
  std::vector<Ray> ways;
  std::vector<std::size_t> of;
  std::vector<std::optional<RayHit>> hits(closings.size());
  NearFaces near;
  for (std::size_t jaw = 0; jaw < 2; ++jaw) {
    ways.clear();
    of.clear();
    for (std::size_t i = 0; i < closings.size(); ++i) {
      if (!contacts[i]) continue;  // its first jaw did not stop
      ways.push_back(WayOf(jaw, closings[i].center, closings[i].axis, opening));
      of.push_back(i);
    }
    scene.Near(ways, &near);
    scene.Closest(ways, near, hits);
    for (std::size_t k = 0; k < ways.size(); ++k) {
      auto& of_draw = contacts[of[k]];
      if (!Stops(hits[k], ways[k].direction, closings[of[k]].friction, &(*of_draw)[jaw])) {
        of_draw.reset();
      }
    }
  }
}

}  // namespace antigrasp
