#pragma once

#include <functional>
#include <string>
#include <vector>

#include "antigrasp/core/observer.h"
#include "antigrasp/core/work_share.h"
#include "antigrasp/perturb/scored_perturbation.h"

namespace antigrasp {

// Objects to be perturbed, and where the results go.
struct PerturbRequest {
  std::vector<std::string> inputs;
  std::string out;  // folder, of PerturbFiles (perturb_folder.h)
  bool overwrite = false;
  std::uint64_t seed = 1;
  int threads = 0;
  std::string constants;       // perturb.toml
  std::string gripper;         // a name or a file, which is not to be written over
  WorkShare* share = nullptr;  // whose ranks do it together; those that help write nothing
};

// Fills the folder; returns what is to be said of it. Once `stop` says so what is done is kept, and
// the rest marked as interrupted. RuntimeFailure, when all is written, where no object was
// perturbed; Interrupted likewise after `stop`, when `say` has had the text.
void PerturbObjects(const PerturbRequest& request, const PerturbSettings& settings,
                    RunObserver* observer, const std::function<void(const std::string&)>& warn,
                    const std::function<void(const std::string&)>& say);

}  // namespace antigrasp
