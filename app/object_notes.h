#pragma once

#include <vector>

#include "antigrasp/datasets/objects.h"

namespace antigrasp {

// A warning for every object that was repaired, read otherwise than its file says, or not read.
void WarnOfNotes(const std::vector<InputObject>& objects);

}  // namespace antigrasp
