#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "antigrasp/core/options.h"
#include "antigrasp/trial/physics_trial.h"

// What somebody asks of a trial, beside its protocol.
namespace antigrasp {

// Options that were typed: they go before what a protocol lays down.
struct TypedTrial {
  std::function<void(OptionTable* table)> apply;            // to keys "trial.*"; nullptr: none
  std::function<std::string(const std::string& key)> text;  // "--mass 0.1" of "trial.mass"; or ""
  bool friction = false;                                    // the metric's was typed, too

  std::string Text(const std::string& key) const { return text ? text(key) : ""; }
  std::string First() const;  // text of the first option of a trial that was typed; "" for none
};

// `options` as the protocol has them, and then as they were typed. `metric` gets the protocol's
// friction, unless one was typed.
PhysicsTrialOptions TrialOptionsOf(const Protocol& protocol, const TypedTrial& typed,
                                   MetricOptions* metric, PhysicsTrialOptions options = {});

// InputError for a typed option that this protocol or fingertip makes no use of. `given`: the
// grasps are.
void RequireOptionsUsed(const Protocol& protocol, TipShape tip, const TypedTrial& typed,
                        bool given = false);

// InputError for a typed option of physics that the metric's model has not.
void RequireModelOptions(const TypedTrial& typed);

// The friction coefficient of a friction angle, in one reading or in both.
std::vector<double> FrictionsOf(std::optional<FrictionReading> chosen, double angle_degrees);

// What a trial is, its protocols and its judges by name: for a command's help.
extern const char* const kTrialHelp;

}  // namespace antigrasp
