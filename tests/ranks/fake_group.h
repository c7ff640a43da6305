#pragma once

#include <condition_variable>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "antigrasp/ranks/rank_group.h"

namespace antigrasp {

// Ranks as threads of one process: what the real group does over the network, in memory.
class ThreadRanks {
 public:
  explicit ThreadRanks(int size) : size_(size), given_(static_cast<std::size_t>(size)) {}

  // body(group) for every rank, each on a thread; returns when all have ended.
  void Run(const std::function<void(RankGroup*)>& body) {
    std::vector<std::thread> threads;
    for (int rank = 0; rank < size_; ++rank) {
      threads.emplace_back([this, rank, &body] {
        Member member(this, rank);
        body(&member);
      });
    }
    for (std::thread& thread : threads) thread.join();
  }

 private:
  class Member : public RankGroup {
   public:
    Member(ThreadRanks* all, int rank) : all_(all), rank_(rank) {}
    int rank() const override { return rank_; }
    int size() const override { return all_->size_; }
    std::vector<torch::Tensor> AllOfFirst(int ranks, const torch::Tensor& mine) override {
      return all_->Exchange(rank_, mine.clone(), ranks);
    }
    torch::Tensor ToEachOfFirst(int ranks, const torch::Tensor& slices) override {
      std::vector<torch::Tensor> mine;
      const std::vector<torch::Tensor> all = all_->Exchange(rank_, slices.clone(), ranks);
      for (int r = 0; r < ranks; ++r) mine.push_back(all[static_cast<std::size_t>(r)][rank_]);
      return torch::stack(mine);
    }
    void FromLeader(torch::Tensor* tensor) override {
      *tensor =
          all_->Exchange(rank_, leads() ? tensor->clone() : torch::Tensor(), size())[0].clone();
    }
    void GiveLeader(const torch::Tensor& tensor) override {
      const std::lock_guard<std::mutex> lock(all_->mutex_);
      all_->for_leader_[rank_] = tensor.clone();
      all_->changed_.notify_all();
    }
    void TakeFrom(int rank, torch::Tensor* tensor) override {
      std::unique_lock<std::mutex> lock(all_->mutex_);
      all_->changed_.wait(lock, [&] { return all_->for_leader_.count(rank) > 0; });
      tensor->copy_(all_->for_leader_.extract(rank).mapped());
    }
    std::int64_t TakeNext(const std::string& counter, std::int64_t count) override {
      const std::lock_guard<std::mutex> lock(all_->mutex_);
      return (all_->counters_[counter] += count) - count;
    }
    void Put(const std::string& name, const std::string& bytes) override {
      const std::lock_guard<std::mutex> lock(all_->mutex_);
      all_->put_[name] = bytes;
      all_->changed_.notify_all();
    }
    std::string Wait(const std::string& name) override {
      std::unique_lock<std::mutex> lock(all_->mutex_);
      all_->changed_.wait(lock, [&] { return all_->put_.count(name) > 0; });
      const std::string bytes = all_->put_[name];
      all_->put_.erase(name);
      return bytes;
    }
    bool Has(const std::string& name) override {
      const std::lock_guard<std::mutex> lock(all_->mutex_);
      return all_->put_.count(name) > 0;
    }

   private:
    ThreadRanks* all_;
    int rank_;
  };

  // Everybody's tensor of the first `ranks`, when all of them have come; the next round begins when
  // all have left.
  std::vector<torch::Tensor> Exchange(int rank, const torch::Tensor& mine, int ranks) {
    std::unique_lock<std::mutex> lock(mutex_);
    changed_.wait(lock, [&] { return leaving_ == 0; });
    given_[static_cast<std::size_t>(rank)] = mine;
    if (++come_ == ranks) {
      leaving_ = ranks;
      come_ = 0;
      changed_.notify_all();
    }
    changed_.wait(lock, [&] { return leaving_ > 0; });
    const std::vector<torch::Tensor> all = given_;
    if (--leaving_ == 0) changed_.notify_all();
    return all;
  }

  int size_, come_ = 0, leaving_ = 0;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<torch::Tensor> given_;
  std::map<std::string, std::int64_t> counters_;
  std::map<std::string, std::string> put_;
  std::map<int, torch::Tensor> for_leader_;
};

}  // namespace antigrasp
