#pragma once

#include <chrono>
#include <exception>
#include <mutex>
#include <string>

#include "antigrasp/core/work_share.h"
#include "antigrasp/ranks/rank_group.h"

namespace antigrasp {

// Loops shared by the ranks of a group, by its store alone: no collective call, in which a rank
// that has failed would keep the others.
class RankedShare : public WorkShare {
 public:
  // At its end rank 0 tells it, and waits for the others, which may be in the middle of an item.
  explicit RankedShare(RankGroup* group) : group_(group) {}
  ~RankedShare() override;
  RankedShare(const RankedShare&) = delete;
  RankedShare& operator=(const RankedShare&) = delete;

  int rank() const override { return group_->rank(); }
  int size() const override { return group_->size(); }
  std::string Told(const std::string& text) override;
  std::int64_t TakeNext(const std::string& counter, std::int64_t count) override;
  void Put(const std::string& name, const std::string& bytes) override;
  std::optional<std::string> TakeIfThere(const std::string& name) override;

  // For what this rank has failed with: rank 0 is to fail with it, too, and one of all says why.
  // Leaves by `error` where that is this one, else by SaidElsewhere. A rank that is not rank 0
  // waits some seconds for it to speak.
  [[noreturn]] void LeaveWith(const std::exception_ptr& error);

 private:
  void TellAll(char kind, const std::string& text);
  void HandIn(const std::exception_ptr& error);
  int FailedWith(int otherwise);

  RankGroup* group_;
  std::chrono::seconds patience_{10};
  std::mutex mutex_;  // of the group
  std::int64_t told_ = 0;
};

}  // namespace antigrasp
