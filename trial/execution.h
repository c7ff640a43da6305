#pragma once

#include <array>
#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "antigrasp/core/choice.h"
#include "antigrasp/trial/physics_engine.h"
#include "antigrasp/trial/protocol.h"

// One execution of one grasp, from open jaws to the end of its protocol.
namespace antigrasp {

enum class Outcome {
  kHeld,                // passed the protocol's first stage
  kSlipped,             // lost while it was lifted or loaded
  kTurnedAway,          // the same, after it had turned by more than 30 degrees in the grasp
  kLostClosing,         // the jaws closed and did not hold it
  kNeverTouched,        // they met without touching it
  kStartedInCollision,  // an open fingertip was in the object or the table
  kUnstable             // the simulation came to numbers that are no physics
};
constexpr auto ChoicesOf(Outcome) {
  return std::to_array<Choice<Outcome>>({{Outcome::kHeld, "held"},
                                         {Outcome::kSlipped, "slipped"},
                                         {Outcome::kTurnedAway, "turned away"},
                                         {Outcome::kLostClosing, "lost closing"},
                                         {Outcome::kNeverTouched, "never touched"},
                                         {Outcome::kStartedInCollision, "started in collision"},
                                         {Outcome::kUnstable, "unstable"}});
}

struct Execution {
  Outcome outcome = Outcome::kUnstable;
  int stages = 0;             // of the protocol that it passed, one after another
  double closing_move = 0.0;  // of the centre of mass while the jaws closed, m
  double closing_turn = 0.0;  // rad
  double move = 0.0;          // farthest from there while it was held, m
  double turn = 0.0;          // rad
  double seconds = 0.0;       // simulated, to the loss or the end
  int contacts = 0;           // of the fingertips when the jaws had closed
  double penetration = 0.0;   // deepest of a fingertip, m
  int steps = 0;              // simulated
  // Penetration up to 0.1 mm: the body is as rigid as the answer needs.
  bool Trusted() const { return penetration <= 1e-4; }
};

enum class Pace {
  kEarly,  // begins shortly before the first touch, with the jaws at the speed they have there, and
           // ends a phase when nothing changes any more: at rest, jammed, or gone
  kFixed   // simulates every phase to its end: the straightforward way, to compare with
};

// Where a replay looks on; called after every step.
struct ReplayFrame {
  double seconds;
  GripState state;
  double table;
  std::vector<ContactForce> contacts;
};
using ReplayFn = std::function<void(const ReplayFrame&)>;

// The engine holds the body (Load) of the mass that the protocol wants. `start`: the jaws open, the
// object in its place; `travel` is found here. Deterministic. Some 300 steps an execution.
Execution Execute(PhysicsEngine* engine, const GrippedBody& body, const PhysicsOptions& options,
                  const Protocol& protocol, GripStart start, Pace pace = Pace::kEarly,
                  const ReplayFn& replay = nullptr);

}  // namespace antigrasp
