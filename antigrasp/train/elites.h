#pragma once

#include <cstdint>
#include <vector>

namespace antigrasp {

// The `keep` objects with the lowest graspability, as ascending indices (V-B, VI-C). NaN marks a
// rejected object and is never kept; ties go to the lower index; fewer valid objects: all of them.
std::vector<std::int64_t> LeastGraspable(const std::vector<double>& graspability,
                                         std::int64_t keep);

// The control: `keep` valid objects drawn without replacement from stream (seed, "control", stage),
// ascending.
std::vector<std::int64_t> RandomKeep(const std::vector<double>& graspability, std::int64_t keep,
                                     std::uint64_t seed, std::uint64_t stage);

}  // namespace antigrasp
