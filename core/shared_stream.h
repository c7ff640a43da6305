#pragma once

#include <functional>
#include <string>
#include <utility>

#include "antigrasp/core/ordered_stream.h"
#include "antigrasp/core/passer.h"
#include "antigrasp/core/work_share.h"

namespace antigrasp {

// make(i) as bytes for every i in [0, count), on `threads` threads (0 = all) of every rank, each of
// which takes the next few items until none is left; take(i, bytes) on rank 0 alone, in the order
// of i, one at a time. Nobody runs far ahead of what is taken. The first exception of any rank
// leaves on it and on rank 0. Progress as OrderedStream, on rank 0, and while it waits.
void ShareStream(WorkShare* share, std::int64_t count, int threads,
                 const std::function<std::string(std::int64_t)>& make,
                 const std::function<void(std::int64_t, const std::string&)>& take,
                 const ProgressFn& progress = nullptr);

// StreamInOrder, shared out where there is a share: the same calls of take, on rank 0, whatever the
// number of ranks. What make returns goes through a Passer.
template <typename Make, typename Take>
void StreamShared(WorkShare* share, std::int64_t count, int threads, const Make& make,
                  const Take& take, const ProgressFn& progress = nullptr) {
  if (share == nullptr) return StreamInOrder(count, threads, make, take, progress);
  using Item = decltype(make(count));
  ShareStream(
      share, count, threads, [&](std::int64_t i) { return PassedBytes(make(i)); },
      [&](std::int64_t i, const std::string& bytes) { take(i, FromPassed<Item>(bytes)); },
      progress);
}

// A value of rank 0, on all; alone it stays.
template <typename T>
void TellAll(WorkShare* share, T* value) {
  if (share == nullptr) return;
  const std::string told = share->Told(share->leads() ? PassedBytes(*value) : "");
  if (!share->leads()) *value = FromPassed<T>(told);
}

}  // namespace antigrasp
