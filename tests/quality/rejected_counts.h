#pragma once

#include <string_view>

#include "antigrasp/quality/rejected_grasps.h"

namespace antigrasp {

// 0 for a reason that is not there.
inline int CountOf(const RejectedGrasps& rejected, std::string_view reason) {
  for (const RejectedGrasps::Reason& r : rejected.reasons) {
    if (r.name == reason) return r.count;
  }
  return 0;
}

// Of all reasons, and copies.
inline int CountOfAll(const RejectedGrasps& rejected) {
  int sum = rejected.copies;
  for (const RejectedGrasps::Reason& reason : rejected.reasons) sum += reason.count;
  return sum;
}

}  // namespace antigrasp
