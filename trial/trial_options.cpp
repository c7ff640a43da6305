#include "antigrasp/core/error.h"
#include "antigrasp/trial/physics_trial.h"

namespace antigrasp {

void RequireOptionsUsed(const Protocol& protocol, TipShape tip,
                        const std::function<std::string(const std::string& key)>& typed,
                        bool given) {
  const auto refuse = [&](const std::string& who, const std::vector<std::string>& keys,
                          const std::string& expected) {
    for (const std::string& key : keys) {
      const std::string text = typed("trial." + key);
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

}  // namespace antigrasp
