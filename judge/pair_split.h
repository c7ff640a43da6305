#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace antigrasp {

// "train", "val" or "test" of every object: which ones is drawn from the seed and the object's own
// stream, so that neither their order nor their folder matters; how many is exact, the shares
// rounded, and at least one of each that has a share where there are as many objects; of fewer the
// first ones of SplitsWithShare have one. Objects of one stream (a name in two folders) are ordered
// by name.
std::vector<std::string> SplitOf(const std::vector<std::string>& names,
                                 const std::vector<std::uint64_t>& streams, double train,
                                 double val, std::uint64_t seed);

// Those that get objects at these shares, what a set needs most first: train, test, val.
std::vector<std::string> SplitsWithShare(double train, double val);

}  // namespace antigrasp
