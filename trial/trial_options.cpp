#include "antigrasp/trial/trial_options.h"

#include <algorithm>

#include "antigrasp/core/error.h"

namespace antigrasp {
namespace {

// Keys of physics; `model`: of the metric's model instead.
std::vector<std::string> TrialKeys(bool model) {
  PhysicsTrialOptions physics;
  TrialOptions series;
  OptionTable table;
  if (model) {
    Bind(&table, &series);
  } else {
    Bind(&table, &physics);
  }
  std::vector<std::string> keys;
  for (const Option& option : table.options()) keys.push_back(option.key);
  return keys;
}

}  // namespace

std::string TypedTrial::First() const {
  for (const std::string& key : TrialKeys(false)) {
    if (!Text(key).empty()) return Text(key);
  }
  return "";
}

PhysicsTrialOptions TrialOptionsOf(const Protocol& protocol, const TypedTrial& typed,
                                   MetricOptions* metric, PhysicsTrialOptions options) {
  MetricOptions of_protocol = *metric;
  ApplyProtocol(protocol, &of_protocol, &options);
  if (!typed.friction) metric->friction = of_protocol.friction;
  OptionTable table;
  Bind(&table, &options);
  if (typed.apply) typed.apply(&table);
  return options;
}

void RequireModelOptions(const TypedTrial& typed) {
  const std::vector<std::string> known = TrialKeys(true);
  for (const std::string& key : TrialKeys(false)) {
    if (typed.Text(key).empty() || std::find(known.begin(), known.end(), key) != known.end()) {
      continue;
    }
    throw InputError("the model has no such thing", typed.Text(key), "--engine mujoco");
  }
}

void RequireOptionsUsed(const Protocol& protocol, TipShape tip, const TypedTrial& typed,
                        bool given) {
  const auto refuse = [&](const std::string& who, const std::vector<std::string>& keys,
                          const std::string& expected) {
    for (const std::string& key : keys) {
      const std::string text = typed.Text("trial." + key);
      if (!text.empty()) throw InputError(who + " has no such thing", text, expected);
    }
  };
  const std::string name = "protocol " + ChoiceName(protocol.name);
  refuse("physics", {"min_epsilon"}, "--engine model");
  if (protocol.choice == GraspChoice::kBestUnused) {
    refuse(name, {"draws"}, "--executions");
  } else {
    refuse(name, {"series", "grasps_per_series", "executions"}, "--draws, or --protocol paper");
  }
  if (given) refuse("a trial of given grasps", {"series", "grasps_per_series"}, "--executions");
  if (!protocol.table) {
    refuse(name, {"approach_cone", "table_clearance", "table_friction"}, "a protocol with a table");
  }
  if (tip == TipShape::kSphere) {
    refuse("a ball", {"pad_width", "pad_height"}, "--tip pad");
  } else {
    refuse("a pad", {"tip_radius", "patch_radius"}, "--tip sphere");
  }
}

std::vector<double> FrictionsOf(std::optional<FrictionReading> chosen, double angle_degrees) {
  std::vector<double> frictions;
  for (const auto [reading, name] : ChoicesOf(FrictionReading{})) {
    if (!chosen || chosen == reading) {
      frictions.push_back(FrictionCoefficient(angle_degrees, reading));
    }
  }
  return frictions;
}

const char* const kTrialHelp =
    "In physics (--engine mujoco) the object rests on a table in a stable pose drawn by its\n"
    "probability; the gripper comes from above, closes by force, lifts and is loaded. Grasps are\n"
    "planned at the trial's friction. Protocols, each from its source (docs/trials.md):\n"
    "  six-ways      every planned grasp; weight in six directions, at 1, 3 and 8 g\n"
    "  paper         five best grasps that were not executed yet, three times each; carried\n"
    "  graspdatagen  no table; five tugs of 1 g; 1 kg, friction 1\n"
    "  dexgraspbench no table; six runs, within 50 mm and 15 degrees; 0.1 kg, friction 0.6\n"
    "Held, in percent of the executions; best: of the grasp of highest robust quality; top: of "
    "the\n"
    "best quarter; last: what the metric says of the same executions, force closure, or with\n"
    "--closing settled that the settled grasp holds. An object that no grasp reaches has no share\n"
    "(paper: 0) and is in no mean. Ctrl-C keeps in --out what was tried; the same call goes on.\n"
    "With --baseline both are tried at their own mass and at --equal-mass, with equal draws.\n\n"
    "--engine model asks the metric's model instead (the paper's Table I): a series plans anew,\n"
    "then, five times, draws a stable pose, takes the best grasp that the gripper reaches and "
    "that\n"
    "was not executed yet, and executes it three times. It holds when both jaws touch first from\n"
    "outside and the line between the contacts lies in both friction cones (force closure), and\n"
    "when epsilon is also above --min-epsilon. A grasp that was not found counts as not held.\n"
    "Reading half-angle takes the friction angle as the cone's half angle, full-cone as the "
    "opening\n"
    "of the whole cone. Intervals allow for executions that share a plan.\n";

}  // namespace antigrasp
