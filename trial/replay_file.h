#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "antigrasp/trial/physics_trial.h"

namespace antigrasp {

// An execution of the object that `trials` tried last, to look at, as JSON (docs/formats.md).
// `side`: "after" or "before". Empty when nothing moved.
std::string ReplayText(const std::string& object, std::string_view side, PhysicsTrials* trials,
                       const Fingertip& tip, const PhysicsTrial& trial, std::size_t grasp,
                       std::size_t draw);

// replays.json.
class ReplayFile {
 public:
  void Add(const std::string& replay);
  // What the file gets next: the replays that were added since the last call; EndText() ends it.
  // A replay takes about 20 kB, so that those of a large set do not fit into memory.
  std::string TakeText();
  std::string EndText();
  // Goes on behind so many bytes of a file that has lost its EndText().
  void GoOnBehind(std::uintmax_t bytes);

 private:
  std::string text_ = "{\"format\":\"antigrasp.replays\",\"version\":1,\"replays\":[\n";
  bool any_ = false;
};

// Which executions of an object are worth a look: the best grasp that was held and the best that
// was lost, up to `each` of them. Pairs of grasp and draw.
std::vector<std::pair<std::size_t, std::size_t>> WorthAReplay(const PhysicsTrial& trial, int each);

}  // namespace antigrasp
