#pragma once

#include <memory>

#include "antigrasp/quality/grasp_model.h"

namespace antigrasp {

// Why a candidate is none when the jaws do not open wide enough, among its reasons.
inline constexpr const char* kTooWide = "nothing within the opening";

// Two parallel jaws with a point contact each (paper III-B, Dex-Net 1.0): antipodal candidates
// (AntipodalSampler), reached by the whole gripper or by the two jaws alone as options.collision
// says (GripperCollision), with epsilon as their quality (ExecutedQuality); with fingertips that
// have a size or objects that settle, TipQuality.
std::unique_ptr<const GraspModel> ParallelJaws(const GraspObject& object,
                                               const MetricOptions& options);

}  // namespace antigrasp
