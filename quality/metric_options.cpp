#include "antigrasp/quality/metric_options.h"

#include <algorithm>

#include "antigrasp/core/error.h"
#include "antigrasp/quality/epsilon.h"

namespace antigrasp {

void ApplyMetricPreset(const std::string& name, MetricOptions* options) {
  MetricOptions preset;
  if (name == "dexnet" || name == "egad") {
    preset.friction = 0.5;
    preset.cone_edges = 8;
    preset.finger_radius = 0.005;  // neither configuration sets it: the code's own default
    preset.torsion = "dexnet";
    preset.object_min_extent = 0.040;
    preset.jaw_opening = 0.05;  // gripper yumi_metal_spline
    preset.percentile = 75.0;   // of the paper and of EGAD; Dex-Net ranks single grasps
    preset.collision = "jaws";  // neither tests the gripper against the object before scoring
  }
  if (name == "dexnet") {
    preset.torque_scale = 1000.0;
    preset.num_grasps = 25;
    preset.num_draws = 25;
    ApplyNoisePreset("dexnet", &preset);
  } else if (name == "egad") {
    preset.torque_scale = 100.0;
    preset.num_grasps = 100;
    preset.num_draws = 1;
    ApplyNoisePreset("none", &preset);
  } else if (name != "default") {
    throw InputError("metric preset '" + name + "'", "metric", "one of default, dexnet, egad");
  }
  *options = preset;
}

double EgadScore(double graspability) {
  constexpr double kHard = 0.0005, kEasy = 0.004;
  return 100.0 * ((std::clamp(graspability, kHard, kEasy) - kHard) / (kEasy - kHard));
}

void ApplyNoisePreset(const std::string& name, MetricOptions* options) {
  struct Noise {
    double object_translation, object_rotation, grasp_translation, grasp_rotation, friction;
  };
  Noise noise;
  if (name == "default") {
    noise = {0.0025, 0.01, 0.00125, 0.001, 0.1};
  } else if (name == "dexnet") {
    noise = {0.01, 0.01, 0.005, 0.001, 0.1};
  } else if (name == "none") {
    noise = {0.0, 0.0, 0.0, 0.0, 0.0};
  } else {
    throw InputError("noise preset '" + name + "'", "metric noise", "one of default, dexnet, none");
  }
  options->object_translation_std = noise.object_translation;
  options->object_rotation_std = noise.object_rotation;
  options->grasp_translation_std = noise.grasp_translation;
  options->grasp_rotation_std = noise.grasp_rotation;
  options->friction_std = noise.friction;
}

void Bind(OptionTable* table, MetricOptions* options) {
  MetricOptions& o = *options;
  table->Add("metric.friction", &o.friction, 0.0, 10.0, "friction coefficient");
  table->Add("metric.cone_edges", &o.cone_edges, 3, 64, "edges of the friction pyramid");
  table->Add("metric.finger_radius", &o.finger_radius, 0.0, 1.0, "soft finger contact radius, m");
  table->Add("metric.torque_scale", &o.torque_scale, 1e-6, 1e9,
             "weight of torques against forces, 1/m");
  table->Add("metric.torsion", &o.torsion, TorsionNames(),
             "torque that a contact carries about its normal, per force: none (two such fingers "
             "score 0), dexnet (pi r^2 mu) or uniform_pressure (2/3 r mu)");
  table->Add("metric.object_min_extent", &o.object_min_extent, 0.0, 100.0,
             "smallest bounding-box extent after rescaling, m; 0 = as it is");
  table->Add("metric.jaw_opening", &o.jaw_opening, 1e-6, 100.0, "widest grasp, m");
  table->Add("metric.num_grasps", &o.num_grasps, 1, 1e6, "grasps scored per object");
  table->Add("metric.num_draws", &o.num_draws, 1, 1e6, "noise draws per grasp");
  table->Add("metric.max_attempts", &o.max_attempts, 1, 1e9, "candidate grasps tried per object");
  table->Add("metric.grasp_separation", &o.grasp_separation, 0.0, 1.0,
             "a grasp whose two contacts both lie this near to another's is left out, m");
  table->Add("metric.adaptive", &o.adaptive,
             "fewer draws for grasps that are clearly above or below the percentile");
  table->Add("metric.percentile", &o.percentile, 0.0, 100.0,
             "percentile of robust quality that is the graspability");
  table->Add("metric.object_translation_std", &o.object_translation_std, 0.0, 10.0,
             "object position noise per axis, m");
  table->Add("metric.object_rotation_std", &o.object_rotation_std, 0.0, 10.0,
             "object rotation noise per axis, rad");
  table->Add("metric.grasp_translation_std", &o.grasp_translation_std, 0.0, 10.0,
             "grasp centre noise per axis, m");
  table->Add("metric.grasp_rotation_std", &o.grasp_rotation_std, 0.0, 10.0,
             "grasp axis rotation noise per axis, rad");
  table->Add("metric.friction_std", &o.friction_std, 0.0, 10.0, "friction noise, clipped at 0");
  table->Add("metric.collision", &o.collision, {"gripper", "jaws"},
             "what must be free of collision: the whole gripper, or the two jaw paths");
  Bind(table, &o.gripper);
}

std::string MetricToml(const MetricOptions& metric, std::uint64_t seed) {
  MetricOptions copy = metric;
  OptionTable table;
  Bind(&table, &copy);
  return "seed = " + std::to_string(seed) + "\n\n" + table.Dump();
}

}  // namespace antigrasp
