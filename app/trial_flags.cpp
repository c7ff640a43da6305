#include "antigrasp/app/trial_flags.h"

namespace antigrasp {

std::shared_ptr<OptionFlags> AddTrialFlags(CLI::App* command) {
  return std::make_shared<OptionFlags>(AddOptions<PhysicsTrialOptions>(command, "Trial"));
}

TypedTrial TypedOf(const CLI::App& command, const OptionFlags& flags) {
  return {[&flags](OptionTable* table) { flags.Apply(table); },
          [&flags](const std::string& key) { return flags.Typed(key); },
          command.count("--friction") > 0};
}

}  // namespace antigrasp
