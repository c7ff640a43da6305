#include "antigrasp/quality/rejected_grasps.h"

#include <algorithm>

namespace antigrasp {

void RejectedGrasps::Add(const RejectedGrasps& other) {
  copies += other.copies;
  for (const Reason& reason : other.reasons) {
    const auto mine = std::find_if(reasons.begin(), reasons.end(),
                                   [&](const Reason& r) { return r.name == reason.name; });
    if (mine == reasons.end()) {
      reasons.push_back(reason);
    } else {
      mine->count += reason.count;
    }
  }
}

}  // namespace antigrasp
