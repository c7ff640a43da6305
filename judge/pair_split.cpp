#include "antigrasp/judge/pair_split.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "antigrasp/core/rng.h"

namespace antigrasp {

std::vector<std::string> SplitOf(const std::vector<std::string>& names,
                                 const std::vector<std::uint64_t>& streams, double train,
                                 double val, std::uint64_t seed) {
  const std::size_t count = names.size();
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto key = [&](std::size_t i) {
    return std::tuple(RngStream(seed, "split", streams[i]).NextU64(), names[i]);
  };
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
  // Held-out objects first: a small set is no use without them.
  const auto share = [&](double part) {
    const auto rounded = static_cast<std::size_t>(std::lround(part * static_cast<double>(count)));
    return part > 1e-9 ? std::max<std::size_t>(rounded, 1) : 0;
  };
  const std::size_t test = share(1.0 - train - val), vals = share(val);
  std::vector<std::string> splits(count, train > 0.0 ? "train" : val > 0.0 ? "val" : "test");
  for (std::size_t k = 0; k < count; ++k) {
    if (k < test) {
      splits[order[k]] = "test";
    } else if (k < test + vals) {
      splits[order[k]] = "val";
    }
  }
  return splits;
}

}  // namespace antigrasp
