#include "antigrasp/quality/jaw_closing.h"

#include <algorithm>

namespace antigrasp {

std::optional<std::array<Contact, 2>> CloseJaws(const RayScene& scene,
                                                const Eigen::Vector3d& center,
                                                const Eigen::Vector3d& axis, double opening,
                                                double friction) {
  std::array<Contact, 2> contacts;
  for (std::size_t i = 0; i < 2; ++i) {
    const Eigen::Vector3d closing = i == 0 ? axis : Eigen::Vector3d(-axis);
    const auto hit = scene.Closest(center - 0.5 * opening * closing, closing, 0.5 * opening);
    if (!hit || !hit->front || Slips(-hit->normal, closing, friction)) return std::nullopt;
    contacts[i] = {hit->point, hit->normal, std::max(-closing.dot(hit->normal), 0.0)};
  }
  return contacts;
}

}  // namespace antigrasp
