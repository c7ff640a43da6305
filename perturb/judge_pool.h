#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "antigrasp/quality/judge.h"

namespace antigrasp {

// Judges for objects that are searched side by side: one at work for each, made when none waits. A
// program is so started once for each thread, not for each object.
class JudgePool {
 public:
  using Maker = std::function<std::unique_ptr<Judge>()>;
  explicit JudgePool(Maker make) : make_(std::move(make)) {}

  // A judge for as long as this lives.
  class Lease {
   public:
    explicit Lease(JudgePool* pool) : pool_(*pool), judge_(pool->Take()) {}
    ~Lease() {
      const std::lock_guard lock(pool_.mutex_);
      pool_.idle_.push_back(std::move(judge_));
    }
    Lease(const Lease&) = delete;
    Lease& operator=(const Lease&) = delete;
    Judge* operator->() const { return judge_.get(); }
    Judge* get() const { return judge_.get(); }

   private:
    JudgePool& pool_;
    std::unique_ptr<Judge> judge_;
  };

 private:
  std::unique_ptr<Judge> Take() {
    {
      const std::lock_guard lock(mutex_);
      if (!idle_.empty()) {
        std::unique_ptr<Judge> judge = std::move(idle_.back());
        idle_.pop_back();
        return judge;
      }
    }
    return make_();
  }

  Maker make_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<Judge>> idle_;
};

}  // namespace antigrasp
