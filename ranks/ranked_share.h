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
  explicit RankedShare(RankGroup* group, std::chrono::seconds patience = std::chrono::seconds(10))
      : group_(group), patience_(patience) {}
  ~RankedShare() override;
  RankedShare(const RankedShare&) = delete;
  RankedShare& operator=(const RankedShare&) = delete;

  int rank() const override { return group_->rank(); }
  int size() const override { return group_->size(); }
  std::string Told(const std::string& text) override;
  std::int64_t TakeNext(const std::string& counter, std::int64_t count) override;
  void Put(const std::string& name, const std::string& bytes) override;
  std::optional<std::string> TakeIfThere(const std::string& name) override;

  // Of another rank than 0: rank 0 is to fail with it, too.
  void Fail(const std::exception_ptr& error);

 private:
  void TellAll(char kind, const std::string& text);

  RankGroup* group_;
  std::chrono::seconds patience_;
  std::mutex mutex_;  // of the group
  std::int64_t told_ = 0;
};

}  // namespace antigrasp
