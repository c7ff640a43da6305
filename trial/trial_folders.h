#pragma once

#include <string>
#include <vector>

#include "antigrasp/trial/trials_csv.h"

namespace antigrasp {

// Who judged: what trials must share to be shown beside each other.
struct TrialJudge {
  std::string engine, protocol, tip;  // "mujoco 2.2.2", "six-ways", "sphere of 5 mm"
  double equal_mass = 0.0;            // kg, of the rows of equal mass; 0 where there are none
};

struct TriedFolders {
  TrialJudge judge;
  std::vector<TrialMean> rows;  // of all grasps, stage after stage as the protocol has them
};

// means.csv and trial.toml of folders that `antigrasp trial --out` wrote, as one table. InputError
// for a file that is missing or damaged, for two judges, and for a friction that two folders tried
// at one kind of mass.
TriedFolders ReadTrialFolders(const std::vector<std::string>& folders);

// What one of them is and came to, for people; how far it came, where it was interrupted.
std::string TrialFolderText(const std::string& folder);

}  // namespace antigrasp
