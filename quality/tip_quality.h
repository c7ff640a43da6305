#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

#include "antigrasp/contact/fingertip.h"
#include "antigrasp/contact/mesh_contact.h"
#include "antigrasp/quality/contact.h"
#include "antigrasp/quality/execution_noise.h"
#include "antigrasp/quality/grasp_model.h"
#include "antigrasp/quality/jaw_settling.h"
#include "antigrasp/quality/metric_options.h"

namespace antigrasp {

// How well an executed grasp holds when fingertips have a size (metric.contact) or the object moves
// before it is judged (metric.closing). Const and thread-safe.
class TipQuality {
 public:
  // Whether these options ask for anything but points at their first contacts.
  static bool Judges(const MetricOptions& options);

  // The object's mesh closed and outward; 3 ms for 2,500 faces.
  TipQuality(const GraspObject& object, const MetricOptions& options);

  // closing = first: epsilon at the first contacts of both tips, 0 where one misses, starts inside
  // or slips. closing = settled: 1 when the object comes to rest between the tips and bears its
  // weight in six directions (JawSettling), else 0. A point that settles is a ball of 0.1 mm.
  double Executed(const Grasp& grasp, const NoiseDraw& noise) const;

  // Where the tips first touch, each by itself on a straight way, at most to the middle; normals
  // are the surface's where a face is touched, the direction to the ball's centre elsewhere. Of a
  // pad one contact stands for the patch: its middle, under the mean normal.
  std::optional<std::array<Contact, 2>> FirstContacts(const Grasp& grasp,
                                                      const NoiseDraw& noise) const;

 private:
  std::optional<Contact> Touch(const Eigen::Isometry3d& frame, double side) const;

  Eigen::Vector3d com_;
  MetricOptions options_;
  Fingertip tip_;
  ContactSolid solid_;
  JawSettling settling_;
};

}  // namespace antigrasp
