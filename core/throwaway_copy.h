#pragma once

#include <functional>

namespace antigrasp {

// Whether `work` returns or throws when a copy of this process does it, which is then thrown away
// with all that it did: false when that dies, as a library may that a damaged file leads out of its
// buffers, or takes longer than `seconds`. True where no process can be made. A fork: milliseconds.
bool ReturnsInACopy(const std::function<void()>& work, unsigned seconds);

}  // namespace antigrasp
