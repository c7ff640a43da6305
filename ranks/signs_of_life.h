#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <thread>

#include <torch/csrc/distributed/c10d/Store.hpp>

namespace antigrasp {

// Tells the other ranks every second that this one lives, and ends this process (exit code 1) when
// one of them has been silent for too long or rank 0's store is gone: whoever waits for a dead one
// would wait for ever. One that has never been heard of is not missed: it may be on its way. What a
// run has saved stays.
class SignsOfLife {
 public:
  // `store`: a connection of its own, which nobody else uses.
  SignsOfLife(c10::intrusive_ptr<c10d::Store> store, int rank, int size, double lost_after_seconds);
  ~SignsOfLife();  // says goodbye: ranks that have left are not missed

 private:
  void Run();

  c10::intrusive_ptr<c10d::Store> store_;
  int rank_, size_;
  double lost_after_;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

}  // namespace antigrasp
