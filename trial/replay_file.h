#pragma once

#include <string>
#include <string_view>

#include "antigrasp/trial/physics_trial.h"

namespace antigrasp {

// replays.json (docs/formats.md): executions to look at.
class ReplayFile {
 public:
  // An execution of the object that `trials` tried last. `side`: "after" or "before".
  void Add(const std::string& object, std::string_view side, PhysicsTrials* trials,
           const Fingertip& tip, const PhysicsTrial& trial, std::size_t grasp, std::size_t draw);
  std::string Text() const;

 private:
  std::string replays_;
};

// Which executions of an object are worth a look: the best grasp that was held and the best that
// was lost, up to `each` of them. Pairs of grasp and draw.
std::vector<std::pair<std::size_t, std::size_t>> WorthAReplay(const PhysicsTrial& trial, int each);

}  // namespace antigrasp
