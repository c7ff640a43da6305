#include "antigrasp/app/trial_flags.h"

namespace antigrasp {

PhysicsTrialOptions TrialOptionsOf(const Protocol& protocol, const CLI::App& command,
                                   const OptionFlags& trial_flags, MetricOptions* metric) {
  PhysicsTrialOptions options;
  MetricOptions of_protocol = *metric;
  ApplyProtocol(protocol, &of_protocol, &options);
  if (command.count("--friction") == 0) metric->friction = of_protocol.friction;
  OptionTable table;
  Bind(&table, &options);
  trial_flags.Apply(&table);
  return options;
}

}  // namespace antigrasp
