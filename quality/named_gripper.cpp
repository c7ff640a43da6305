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
    {"yumi",
     "ABB YuMi servo gripper with Dex-Net's fingers",
     MetricOptions{}.jaw_opening,
     {},
     "yumi",
     "gripper_r_base",
     LinkAxis::kX,
     "gripper_r_joint gripper_r_joint_m",
     0.025,
     0.0},
    {"panda",
     "Franka Hand, standard fingers",
     0.080,
     {.palm_distance = 0.0374,
      .fingertip_overlap = 0.0095,
      .finger_width = 0.0175,
      .finger_thickness = 0.0152,
      .palm_depth = 0.0660,
      .palm_length = 0.2044,
      .palm_width = 0.0633},
     "franka_panda",
     "panda_hand",
     LinkAxis::kY,
     "panda_finger_joint1 panda_finger_joint2",
     0.04,
     0.0},
    {"robotiq_85",
     "Robotiq 2F-85, rubber pads",
     0.085,
     {.palm_distance = 0.0403,
      .fingertip_overlap = 0.0188,
      .finger_width = 0.0220,
      .finger_thickness = 0.0169,
      .palm_depth = 0.0900,
      .palm_length = 0.1484,
      .palm_width = 0.0750},
     "robotiq_2f_85",
     "robotiq_arg2f_base_link",
     LinkAxis::kY,
     "finger_joint",
     0.0,
     0.8},
    {"robotiq_140",
     "Robotiq 2F-140, rubber pads",
     0.140,
     {.palm_distance = 0.0870,
      .fingertip_overlap = 0.0325,
      .finger_width = 0.0270,
      .finger_thickness = 0.0171,
      .palm_depth = 0.0900,
      .palm_length = 0.2024,
      .palm_width = 0.0750},
     "robotiq_2f_140",
     "robotiq_arg2f_base_link",
     LinkAxis::kY,
     "finger_joint",
     0.0,
     0.7},
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

int Along(LinkAxis axis) { return static_cast<int>(axis) % 3; }

// The keys of a gripper whose lengths no other gripper can stand in for, by their targets.
std::array<double*, 8> Lengths(MetricOptions* options) {
  GripperModel& m = options->gripper;
  return {&options->jaw_opening, &m.palm_distance, &m.fingertip_overlap, &m.finger_width,
          &m.finger_thickness,   &m.palm_depth,    &m.palm_length,       &m.palm_width};
}

void ApplyGripperFile(const std::string& path, MetricOptions* options, GripperBase* base) {
  MetricOptions read = *options;
  for (double* length : Lengths(&read)) *length = std::numeric_limits<double>::quiet_NaN();
  OptionTable table;
  BindGripper(&table, &read);
  Bind(&table, base);
  table.ApplyFile(path);
  if (Along(base->approach) == Along(base->closing)) {
    throw InputError("base.closing = " + ChoiceName(base->closing), path,
                     "an axis across base.approach = " + ChoiceName(base->approach));
  }
  for (const Option& option : table.options()) {
    const auto* number = std::get_if<double*>(&option.target);
    if (number == nullptr || !std::isnan(**number)) continue;
    throw InputError("no " + option.key, path,
                     "every length of the gripper (an example: antigrasp gripper yumi)");
  }
  *options = read;
}

const NamedGripper* FindOrRequireFile(const std::string& name_or_file) {
  const NamedGripper* const named = Find(name_or_file);
  const std::filesystem::path path = name_or_file;
  if (named == nullptr && path.extension() != ".toml" && !std::filesystem::exists(path)) {
    throw InputError("no gripper " + name_or_file, "--gripper",
                     Alternatives(Names()) + " or a TOML file; the nearest name is " +
                         Nearest(name_or_file, Names()));
  }
  return named;
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
  if (const NamedGripper* named = FindOrRequireFile(name_or_file)) {
    MetricOptions of_name = *options;
    of_name.jaw_opening = named->jaw_opening;
    of_name.gripper = named->model;
    MetricOptions result = *options;  // the way in stays
    const auto from = Lengths(&of_name), to = Lengths(&result);
    for (std::size_t i = 0; i < to.size(); ++i) *to[i] = *from[i];
    *options = result;
    return;
  }
  GripperBase base;  // which its keys may be about
  ApplyGripperFile(name_or_file, options, &base);
}

GripperBase BaseOf(const std::string& name_or_file) {
  GripperBase base;
  if (const NamedGripper* named = FindOrRequireFile(name_or_file)) {
    base = {std::string(named->name),
            std::string(named->asset),
            std::string(named->frame),
            LinkAxis::kZ,
            named->closing,
            std::string(named->joints),
            named->joint_open,
            named->joint_closed};
  } else {
    base.name = std::filesystem::path(name_or_file).stem().string();
    MetricOptions metric;
    ApplyGripperFile(name_or_file, &metric, &base);
  }
  return base;
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

void Bind(OptionTable* table, GripperBase* base) {
  table->Add("base.name", &base->name, {},
             "of the gripper in files of grasps (ACRONYM, Dex-Net, isaac_grasp)");
  table->Add("base.asset", &base->asset, {}, "the same in GraspGen and MultiGripperGrasp");
  table->Add("base.frame", &base->frame, {},
             "link whose pose such files hold, palm_distance + palm_depth behind the grasp");
  table->Add("base.approach", &base->approach, "axis of that link that points out of the palm");
  table->Add("base.closing", &base->closing, "axis of that link from jaw 1 to jaw 2");
  table->Add("base.joints", &base->joints, {}, "of the fingers, a blank between names");
  table->Add("base.joint_open", &base->joint_open, -100.0, 100.0,
             "of each joint at the full opening, m or rad");
  table->Add("base.joint_closed", &base->joint_closed, -100.0, 100.0,
             "of each joint at no opening, m or rad; linear between");
}

std::string GripperToml(const MetricOptions& options, const GripperBase& base,
                        const std::string& about) {
  MetricOptions copy = options;
  GripperBase base_copy = base;
  OptionTable table;
  BindGripper(&table, &copy);
  Bind(&table, &base_copy);
  return "# " + about + "\n" + table.Dump();
}

}  // namespace antigrasp
