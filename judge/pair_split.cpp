#include "antigrasp/judge/pair_split.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "antigrasp/core/rng.h"

namespace antigrasp {
namespace {

constexpr double kNoShare = 1e-9;

}  // namespace

std::vector<std::string> SplitsWithShare(double train, double val) {
  std::vector<std::string> splits;
  if (train > kNoShare) splits.emplace_back("train");
  if (1.0 - train - val > kNoShare) splits.emplace_back("test");
  if (val > kNoShare) splits.emplace_back("val");
  return splits;
}

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
  const auto share = [&](double part) {
    const auto rounded = static_cast<std::size_t>(std::lround(part * static_cast<double>(count)));
    return part > kNoShare ? std::max<std::size_t>(rounded, 1) : 0;
  };
  std::size_t test = share(1.0 - train - val), vals = share(val);
  // Something to train on comes first; then a test counts more than what training is watched by.
  const std::size_t trained = train > kNoShare ? std::min<std::size_t>(count, 1) : 0;
  while (test + vals + trained > count) --(vals >= test ? vals : test);
  std::vector<std::string> splits(count, train > kNoShare ? "train"
                                         : val > kNoShare ? "val"
                                                          : "test");
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
