#include "antigrasp/mesh/triangle_strip.h"

#include <utility>

namespace antigrasp {

void AppendStrips(const std::vector<std::int64_t>& corners, PolygonSoup* soup) {
  std::size_t length = 0;  // of the strip so far
  for (std::size_t i = 0; i < corners.size(); ++i) {
    length = corners[i] == kStripRestart ? 0 : length + 1;
    if (length < 3) continue;
    std::int64_t a = corners[i - 2], b = corners[i - 1];
    const std::int64_t c = corners[i];
    if (a == b || b == c || c == a) continue;
    if (length % 2 == 0) std::swap(a, b);
    soup->corners.insert(soup->corners.end(), {a, b, c});
    soup->EndPolygon();
  }
}

}  // namespace antigrasp
