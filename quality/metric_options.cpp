#include "antigrasp/quality/metric_options.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "antigrasp/core/error.h"
#include "antigrasp/core/format.h"

namespace antigrasp {

namespace {

// What the configurations of Dex-Net and EGAD have in common.
MetricOptions Peers() {
  MetricOptions preset;
  preset.friction = 0.5;
  preset.cone_edges = 8;
  preset.finger_radius = 0.005;  // neither configuration sets it: the code's own default
  preset.torsion = Torsion::kDexNet;
  preset.object_min_extent = 0.040;
  preset.jaw_opening = 0.05;            // gripper yumi_metal_spline
  preset.percentile = 75.0;             // of the paper and of EGAD; Dex-Net ranks single grasps
  preset.collision = Collision::kJaws;  // neither tests the gripper against the object
  return preset;
}

MetricOptions DexNet() {
  MetricOptions preset = Peers();
  preset.torque_scale = 1000.0;
  preset.num_grasps = 25;
  preset.num_draws = 25;
  ApplyNoisePreset("dexnet", &preset);
  return preset;
}

MetricOptions Egad() {
  MetricOptions preset = Peers();
  preset.torque_scale = 100.0;
  preset.num_grasps = 100;
  preset.num_draws = 1;
  ApplyNoisePreset("none", &preset);
  return preset;
}

MetricOptions Settled() {
  MetricOptions preset;
  JudgeSettled(&preset);
  return preset;
}

// The one list of each kind of preset.
struct Preset {
  std::string_view name;
  MetricOptions (*make)();
};
constexpr std::array<Preset, 4> kPresets = {{{"default", [] { return MetricOptions(); }},
                                             {"settled", Settled},
                                             {"dexnet", DexNet},
                                             {"egad", Egad}}};

struct Noise {
  std::string_view name;
  double object_translation, object_rotation, grasp_translation, grasp_rotation, friction;
};
constexpr std::array<Noise, 3> kNoises = {{{"default", 0.0025, 0.01, 0.00125, 0.001, 0.1},
                                           {"dexnet", 0.01, 0.01, 0.005, 0.001, 0.1},
                                           {"none", 0.0, 0.0, 0.0, 0.0, 0.0}}};

template <class List>
std::vector<std::string> NamesOf(const List& list) {
  std::vector<std::string> names;
  for (const auto& item : list) names.emplace_back(item.name);
  return names;
}

template <class List>
const auto& Named(const List& list, const std::string& name, const std::string& what) {
  for (const auto& item : list) {
    if (item.name == name) return item;
  }
  std::string expected;
  for (const std::string& known : NamesOf(list)) {
    expected += (expected.empty() ? "one of " : ", ") + known;
  }
  throw InputError(what + " preset '" + name + "'", what, expected);
}

void BindOpening(OptionTable* table, MetricOptions* options) {
  table->Add("metric.jaw_opening", &options->jaw_opening, 1e-6, 100.0, "widest grasp, m");
}

}  // namespace

std::vector<std::string> MetricPresetNames() { return NamesOf(kPresets); }
std::vector<std::string> NoisePresetNames() { return NamesOf(kNoises); }

void ApplyMetricPreset(const std::string& name, MetricOptions* options) {
  *options = Named(kPresets, name, "metric").make();
}

void JudgeSettled(MetricOptions* options) {
  if (options->contact == TipContact::kPoint) options->contact = TipContact::kSphere;
  options->closing = ClosingEnd::kSettled;
  options->summary = Summary::kMean;
  // One draw of a hundred grasps says more of an object than ten of ten.
  if (options->num_draws == MetricOptions().num_draws) options->num_draws = 1;
}

double EgadScore(double graspability) {
  constexpr double kHard = 0.0005, kEasy = 0.004;
  return 100.0 * ((std::clamp(graspability, kHard, kEasy) - kHard) / (kEasy - kHard));
}

void ApplyNoisePreset(const std::string& name, MetricOptions* options) {
  const Noise& noise = Named(kNoises, name, "metric noise");
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
  table->Add("metric.torsion", &o.torsion,
             "torque that a contact carries about its normal, per force: none (two such fingers "
             "score 0), dexnet (pi r^2 mu) or uniform_pressure (2/3 r mu)");
  table->Add("metric.object_min_extent", &o.object_min_extent, 0.0, 100.0,
             "smallest bounding-box extent after rescaling, m; 0 = as it is (--true-size)");
  table->Add(
      "metric.units", &o.units,
      "what the meshes' coordinates are in: mm, cm, m or in (of an SDF file: of the meshes "
      "imported with one factor, else the side of its cube; 3MF and GLB say it themselves); counts "
      "where objects keep their size");
  BindOpening(table, &o);
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
  table->Add("metric.collision", &o.collision,
             "what must be free of collision: the whole gripper, or the two jaw paths");
  table->Add("metric.contact", &o.contact,
             "what touches the object: the jaws' line, balls of metric.ball_radius, or flat pads");
  table->Add("metric.closing", &o.closing,
             "an executed grasp is judged at the first contacts (epsilon), or when the object has "
             "settled between the jaws (1 when it bears its weight, else 0)");
  table->Add("metric.ball_radius", &o.ball_radius, 1e-4, 0.1, "of a ball, m");
  table->Add("metric.patch_width", &o.patch_width, 1e-4, 0.5, "across grasp axis and way in, m");
  table->Add("metric.patch_height", &o.patch_height, 1e-4, 0.5, "along the way in, m");
  table->Add("metric.held_mass", &o.held_mass, 0.0, 1e3,
             "of every object, kg; counts where it settles");
  table->Add("metric.grip_force", &o.grip_force, 1e-3, 1e5,
             "of each jaw, N; counts where it settles");
  table->Add("metric.summary", &o.summary,
             "which of the grasps' robust qualities is the graspability: their percentile or mean");
  Bind(table, &o.gripper);
}

void BindGripper(OptionTable* table, MetricOptions* options) {
  BindOpening(table, options);
  Bind(table, &options->gripper);
}

std::string OptionText(const std::string& key, double value, const TypedOption& typed) {
  const std::string text = typed ? typed(key) : "";
  return text.empty() ? key + " = " + FormatDouble(value) : text;
}

std::string MetricToml(const MetricOptions& metric, std::uint64_t seed) {
  MetricOptions copy = metric;
  OptionTable table;
  Bind(&table, &copy);
  return "seed = " + std::to_string(seed) + "\n\n" + table.Dump();
}

}  // namespace antigrasp
