#include "antigrasp/quality/rejected_grasps.h"

#include <algorithm>

namespace antigrasp {

int RejectedGrasps::Of(std::string_view reason) const {
  const auto found = std::find_if(reasons.begin(), reasons.end(),
                                  [&](const Reason& r) { return r.name == reason; });
  return found == reasons.end() ? 0 : found->count;
}

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
