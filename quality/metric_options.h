#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "antigrasp/core/choice.h"
#include "antigrasp/core/options.h"
#include "antigrasp/mesh/length_unit.h"
#include "antigrasp/quality/epsilon.h"
#include "antigrasp/quality/gripper.h"

namespace antigrasp {

// Which grasps count as reachable.
enum class Collision {
  kGripper,  // some straight way in of the gripper is free
  kJaws,     // the paths of the two jaws are
};
constexpr auto ChoicesOf(Collision) {
  return std::to_array<Choice<Collision>>(
      {{Collision::kGripper, "gripper"}, {Collision::kJaws, "jaws"}});
}

// What touches the object (docs/metric.md, "Contact and closing").
enum class TipContact {
  kPoint,   // the jaws' line alone, as Dex-Net
  kSphere,  // balls of ball_radius
  kPad      // flat pads
};
constexpr auto ChoicesOf(TipContact) {
  return std::to_array<Choice<TipContact>>(
      {{TipContact::kPoint, "point"}, {TipContact::kSphere, "sphere"}, {TipContact::kPad, "pad"}});
}

// When an executed grasp is judged.
enum class ClosingEnd {
  kFirst,   // at the first contacts: epsilon, 0 when one slips
  kSettled  // when the object has come to rest between the jaws: 1 when it bears its weight, else 0
};
constexpr auto ChoicesOf(ClosingEnd) {
  return std::to_array<Choice<ClosingEnd>>(
      {{ClosingEnd::kFirst, "first"}, {ClosingEnd::kSettled, "settled"}});
}

// Which number of its grasps' robust qualities an object has.
enum class Summary { kPercentile, kMean };
constexpr auto ChoicesOf(Summary) {
  return std::to_array<Choice<Summary>>(
      {{Summary::kPercentile, "percentile"}, {Summary::kMean, "mean"}});
}

// Every constant of the metric (docs/metric.md). Two graspabilities compare only when all are
// equal, so all are written into every result file. Lengths in metres, angles in radians.
struct MetricOptions {
  // Contact and wrench model (Dex-Net 1.0).
  double friction = 0.5;
  int cone_edges = 8;
  double finger_radius = 0.005;  // soft finger
  double torque_scale = 1000.0;  // 1 / m
  Torsion torsion = Torsion::kDexNet;
  // Object and gripper.
  double object_min_extent = 0.040;  // smallest bounding-box extent after rescaling; 0 = as it is
  double jaw_opening = 0.05;         // widest grasp
  // Sampling.
  int num_grasps = 100;
  int num_draws = 25;
  int max_attempts = 4000;         // candidate grasps tried per object
  double grasp_separation = 1e-4;  // nearer than this, both contacts, two grasps are one
  double percentile = 75.0;
  bool adaptive = false;  // fewer draws for grasps far from the percentile (adaptive_draws.h)
  // Noise (standard deviations).
  double object_translation_std = 0.0025;
  double object_rotation_std = 0.01;
  double grasp_translation_std = 0.00125;
  double grasp_rotation_std = 0.001;
  double friction_std = 0.1;
  Collision collision = Collision::kGripper;
  GripperModel gripper;
  LengthUnit units = LengthUnit::kM;  // of the meshes; counts where objects keep their size
  // Fingertips that have a size, and objects that move before they are judged.
  TipContact contact = TipContact::kPoint;
  ClosingEnd closing = ClosingEnd::kFirst;
  double ball_radius = 0.005;  // of a ball
  double patch_width = 0.02;   // across grasp axis and way in
  double patch_height = 0.02;  // along the way in
  double held_mass = 0.05;     // of every object, kg; counts where it settles
  double grip_force = 15.0;    // of each jaw, N; counts where it settles
  Summary summary = Summary::kPercentile;
};

// Sets every constant to "default" (above), "settled" (the share of executions that a settled
// grasp of balls holds: what follows trials in physics best, docs/metric.md), "dexnet" or "egad".
// Dex-Net: test/config.yaml of BerkeleyAutomation/dex-net cccf933, 25 grasps and its own noise.
// EGAD (Morrison et al. 2020): scripts/cfg of dougsm/egad, torque scale 100 / m and no noise, so
// one draw is all draws. InputError, with nothing changed, for another name than those of
// MetricPresetNames().
void ApplyMetricPreset(const std::string& name, MetricOptions* options);

// Makes these the constants of the preset "settled" in what it changes: fingertips (balls, where
// nothing else is said), settled contacts, the mean, one draw a grasp where there are the
// default's.
void JudgeSettled(MetricOptions* options);

// EGAD's score of a graspability under its preset: 0 (epsilon up to 0.0005, hard to grasp) to 100
// (0.004 and above, easy), linear between. EGAD cuts it to a whole number.
double EgadScore(double graspability);

// Sets the noise to "default" (above), "dexnet" (0.01, 0.01, 0.005, 0.001, 0.1) or "none".
// InputError as above.
void ApplyNoisePreset(const std::string& name, MetricOptions* options);

std::vector<std::string> MetricPresetNames();
std::vector<std::string> NoisePresetNames();

// What somebody typed for the option of this key, "--jaw-opening 0.085"; "" for what nobody did.
using TypedOption = std::function<std::string(const std::string& key)>;
// That, or "metric.jaw_opening = 0.085" where there is none: how messages name an option.
std::string OptionText(const std::string& key, double value, const TypedOption& typed);

void Bind(OptionTable* table, MetricOptions* options);  // keys "metric.*", "gripper.*"
// Of these the gripper's own: "metric.jaw_opening" and "gripper.*".
void BindGripper(OptionTable* table, MetricOptions* options);

// What belongs beside a table of scores: the seed and every constant, as TOML.
std::string MetricToml(const MetricOptions& metric, std::uint64_t seed);

}  // namespace antigrasp
