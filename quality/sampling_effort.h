#pragma once

#include <cstdint>
#include <string>

#include "antigrasp/quality/metric_options.h"

// How many grasps an object is scored on where nobody asked for a number. The paper's 100 are for
// sets, of which the mean is looked at: of one object they leave 20 to 40 % of doubt. A few objects
// are looked at one by one, and 1000 grasps leave 4 to 9 %.
namespace antigrasp {

inline constexpr std::int64_t kFewObjects = 100;
inline constexpr int kGraspsOfFew = 1000;

// Up to kFewObjects objects: kGraspsOfFew grasps each, and as many times more candidates. For more
// of them the options stay as they are.
void RaiseEffortForFew(std::int64_t objects, MetricOptions* options);

// The rule, for the help of commands that keep to it.
std::string EffortRule();

// What was decided, a line for people: "1000 grasps an object, as there are at most 100 objects".
std::string EffortText(std::int64_t objects, const MetricOptions& options);

}  // namespace antigrasp
