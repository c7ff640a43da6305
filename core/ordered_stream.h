#pragma once

#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "antigrasp/core/parallel.h"

namespace antigrasp {

// Runs make(i, slot) for every i in [0, count) on `threads` threads (0 = all), and take(i, slot) in
// the order of i, one at a time, once make(i) and all earlier takes have run. Slots are in
// [0, SlotsOf(threads)), each of one item from make to take; a thread that is that far ahead waits.
// The first exception of either stops the work and is rethrown here. Progress is reported after
// each take.
void OrderedStream(std::int64_t count, int threads,
                   const std::function<void(std::int64_t, std::size_t)>& make,
                   const std::function<void(std::int64_t, std::size_t)>& take,
                   const ProgressFn& progress = nullptr);
std::size_t SlotsOf(int threads);

// The same with values: take(i, make(i)). At most a few values a thread exist at a time, however
// many there are in all.
template <typename Make, typename Take>
void StreamInOrder(std::int64_t count, int threads, const Make& make, const Take& take,
                   const ProgressFn& progress = nullptr) {
  std::vector<std::optional<decltype(make(count))>> values(SlotsOf(threads));
  OrderedStream(
      count, threads, [&](std::int64_t i, std::size_t slot) { values[slot].emplace(make(i)); },
      [&](std::int64_t i, std::size_t slot) {
        take(i, *std::move(values[slot]));
        values[slot].reset();
      },
      progress);
}

}  // namespace antigrasp
