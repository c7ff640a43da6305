#pragma once

#include "antigrasp/quality/rejected_grasps.h"

namespace antigrasp {

// Of every reason, and copies.
inline int CountOfAll(const RejectedGrasps& rejected) {
  int sum = rejected.copies;
  for (const RejectedGrasps::Reason& reason : rejected.reasons) sum += reason.count;
  return sum;
}

}  // namespace antigrasp
