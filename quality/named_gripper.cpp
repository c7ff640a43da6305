#include "antigrasp/quality/named_gripper.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>

#include "antigrasp/core/choice.h"
#include "antigrasp/core/error.h"
#include "antigrasp/core/format.h"
#include "antigrasp/core/nearest.h"
#include "antigrasp/quality/object_size.h"

namespace antigrasp {
namespace {

// Openings add up to the last digit only; 1 nm is no part that does not fit.
constexpr double kFitSlack = 1e-9;

constexpr std::array<NamedGripper, 4> kGrippers = {{
    {"yumi", "ABB YuMi servo gripper with Dex-Net's fingers", MetricOptions{}.jaw_opening, {}},
    {"panda",
     "Franka Hand, standard fingers",
     0.080,
     {.palm_distance = 0.0374,
      .fingertip_overlap = 0.0095,
      .finger_width = 0.0175,
      .finger_thickness = 0.0152,
      .palm_depth = 0.0660,
      .palm_length = 0.2044,
      .palm_width = 0.0633}},
    {"robotiq_85",
     "Robotiq 2F-85, rubber pads",
     0.085,
     {.palm_distance = 0.0403,
      .fingertip_overlap = 0.0188,
      .finger_width = 0.0220,
      .finger_thickness = 0.0169,
      .palm_depth = 0.0900,
      .palm_length = 0.1484,
      .palm_width = 0.0750}},
    {"robotiq_140",
     "Robotiq 2F-140, rubber pads",
     0.140,
     {.palm_distance = 0.0870,
      .fingertip_overlap = 0.0325,
      .finger_width = 0.0270,
      .finger_thickness = 0.0171,
      .palm_depth = 0.0900,
      .palm_length = 0.2024,
      .palm_width = 0.0750}},
}};

const NamedGripper* Find(const std::string& name) {
  for (const NamedGripper& gripper : kGrippers) {
    if (gripper.name == name) return &gripper;
  }
  return nullptr;
}

std::vector<std::string> Names() {
  std::vector<std::string> names;
  for (const NamedGripper& gripper : kGrippers) names.emplace_back(gripper.name);
  return names;
}

// The keys of a gripper whose lengths no other gripper can stand in for, by their targets.
std::array<double*, 8> Lengths(MetricOptions* options) {
  GripperModel& m = options->gripper;
  return {&options->jaw_opening, &m.palm_distance, &m.fingertip_overlap, &m.finger_width,
          &m.finger_thickness,   &m.palm_depth,    &m.palm_length,       &m.palm_width};
}

void ApplyGripperFile(const std::string& path, MetricOptions* options) {
  MetricOptions read = *options;
  for (double* length : Lengths(&read)) *length = std::numeric_limits<double>::quiet_NaN();
  OptionTable table;
  BindGripper(&table, &read);
  table.ApplyFile(path);
  for (const Option& option : table.options()) {
    const auto* number = std::get_if<double*>(&option.target);
    if (number == nullptr || !std::isnan(**number)) continue;
    throw InputError("no " + option.key, path,
                     "every length of the gripper (an example: antigrasp gripper yumi)");
  }
  *options = read;
}

// Of the lengths that have to fit each other those that were typed, else those that are not as they
// are by default.
std::string WhatSetsTheFit(const MetricOptions& options, const TypedOption& typed) {
  const MetricOptions defaults;
  struct Length {
    const char* key;
    double value, by_default;
  };
  const Length lengths[] = {
      {"metric.jaw_opening", options.jaw_opening, defaults.jaw_opening},
      {"gripper.finger_thickness", options.gripper.finger_thickness,
       defaults.gripper.finger_thickness},
      {"gripper.palm_length", options.gripper.palm_length, defaults.gripper.palm_length}};
  std::string typed_ones, others;
  for (const auto& [key, value, by_default] : lengths) {
    const bool was_typed = typed && !typed(key).empty();
    if (!was_typed && value == by_default) continue;
    std::string& list = was_typed ? typed_ones : others;
    list += (list.empty() ? "" : ", ") + OptionText(key, value, typed);
  }
  return typed_ones.empty() ? others : typed_ones;
}

}  // namespace

std::span<const NamedGripper> NamedGrippers() { return kGrippers; }

std::string GripperList() {
  constexpr double kMillimetres = 1000.0;
  char line[256];
  std::snprintf(line, sizeof line, "%-12s %8s  %-19s %-16s %-19s %s\n", "name, mm", "opening",
                "finger w x t x l", "beyond the grasp", "palm l x w x d", "");
  std::string list = line;
  for (const NamedGripper& gripper : kGrippers) {
    const GripperModel& m = gripper.model;
    const auto sizes = [](double a, double b, double c) {
      char text[64];
      std::snprintf(text, sizeof text, "%.4g x %.4g x %.4g", kMillimetres * a, kMillimetres * b,
                    kMillimetres * c);
      return std::string(text);
    };
    std::snprintf(
        line, sizeof line, "%-12s %8.4g  %-19s %-16.4g %-19s ", std::string(gripper.name).c_str(),
        kMillimetres * gripper.jaw_opening,
        sizes(m.finger_width, m.finger_thickness, m.palm_distance + m.fingertip_overlap).c_str(),
        kMillimetres * m.fingertip_overlap,
        sizes(m.palm_length, m.palm_width, m.palm_depth).c_str());
    list += line + std::string(gripper.about) + "\n";
  }
  return list;
}

std::string AboutGripper(const std::string& name_or_file) {
  const NamedGripper* const named = Find(name_or_file);
  if (named == nullptr) return name_or_file;
  return std::string(named->about) + "; sources: docs/grippers.md";
}

void ApplyGripper(const std::string& name_or_file, MetricOptions* options) {
  if (const NamedGripper* named = Find(name_or_file)) {
    MetricOptions of_name = *options;
    of_name.jaw_opening = named->jaw_opening;
    of_name.gripper = named->model;
    MetricOptions result = *options;  // the way in stays
    const auto from = Lengths(&of_name), to = Lengths(&result);
    for (std::size_t i = 0; i < to.size(); ++i) *to[i] = *from[i];
    *options = result;
    return;
  }
  const std::filesystem::path path = name_or_file;
  if (path.extension() != ".toml" && !std::filesystem::exists(path)) {
    throw InputError("no gripper " + name_or_file, "--gripper",
                     Alternatives(Names()) + " or a TOML file; the nearest name is " +
                         Nearest(name_or_file, Names()));
  }
  ApplyGripperFile(name_or_file, options);
}

void RequireFittingGripper(const MetricOptions& options, const std::string& origin,
                           const TypedOption& typed) {
  if (options.collision != Collision::kGripper) return;
  const GripperModel& model = options.gripper;
  const double fingers = options.jaw_opening + 2.0 * model.finger_thickness;
  if (!(model.palm_length < fingers - kFitSlack)) return;
  MetricOptions lengths = options;
  lengths.units = LengthUnit::kM;  // that of meshes has no part in it
  const std::vector<std::string> unlikely = UnlikelyLengths(lengths, typed);
  if (!unlikely.empty()) {
    throw InputError(unlikely.front(), origin, "metres; --gripper sets what belongs together");
  }
  char expected[160];
  std::snprintf(expected, sizeof expected,
                "a palm of at least %.6g m (it has %.6g), the opening and two fingers; --gripper "
                "sets what belongs together",
                fingers, model.palm_length);
  throw InputError("the palm is narrower than the open fingers: " + WhatSetsTheFit(options, typed),
                   origin, expected);
}

std::string GripperToml(const MetricOptions& options, const std::string& about) {
  MetricOptions copy = options;
  OptionTable table;
  BindGripper(&table, &copy);
  return "# " + about + "\n" + table.Dump();
}

}  // namespace antigrasp
