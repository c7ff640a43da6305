#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "antigrasp/quality/gripper_base.h"
#include "antigrasp/quality/metric_options.h"

namespace antigrasp {

// A gripper that people have: its opening and its boxes (gripper.h), metres.
struct NamedGripper {
  std::string_view name;
  std::string_view about;
  double jaw_opening;
  GripperModel model;
  std::string_view asset, frame;  // GripperBase; the approach is z of the frame
  LinkAxis closing;
  std::string_view joints;
  double joint_open, joint_closed;
};

// The one list. Every number's source is in docs/grippers.md.
std::span<const NamedGripper> NamedGrippers();

// The same as a table for people, millimetres.
std::string GripperList();

// A line about a named gripper; of a file its name.
std::string AboutGripper(const std::string& name_or_file);

// Sets the opening and the lengths of fingers and palm to those of a named gripper, or of a TOML
// file with the same keys (docs/formats.md), which may set the way in, too. InputError, with
// nothing changed, for another name, an unknown key, a value out of range and a file that leaves a
// length out: a part of another gripper would stand in for it.
void ApplyGripper(const std::string& name_or_file, MetricOptions* options);

// How other programs know it. A file may say so in keys "base.*"; one without them is called after
// itself, its base's z is the approach and x the closing direction. InputError as above, and for
// two directions along one line.
GripperBase BaseOf(const std::string& name_or_file);

// InputError when the palm is narrower than the open fingers that it carries. It names what was
// typed, or what is not as it is by default, and the unit that a length above a metre speaks for.
// Not asked of a metric that looks at the jaws alone.
void RequireFittingGripper(const MetricOptions& options, const std::string& origin,
                           const TypedOption& typed = nullptr);

// The file that ApplyGripper and BaseOf read, `about` as its first line.
std::string GripperToml(const MetricOptions& options, const GripperBase& base,
                        const std::string& about);

}  // namespace antigrasp
