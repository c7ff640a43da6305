#pragma once

#include <functional>
#include <string>
#include <vector>

#include "antigrasp/datasets/objects.h"
#include "antigrasp/quality/metric_options.h"

namespace antigrasp {

using WarnFn = std::function<void(const std::string&)>;

// A warning for every object that was repaired, read otherwise than its file says, or not read.
void WarnOfNotes(const std::vector<InputObject>& objects, const WarnFn& warn);

// Warnings for sizes that speak for another unit than --units (UnlikelySizes).
void WarnOfSizes(const std::vector<InputObject>& objects, const MetricOptions& metric,
                 const WarnFn& warn);

}  // namespace antigrasp
