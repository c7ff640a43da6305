#pragma once

#include <torch/types.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "antigrasp/core/launch.h"

namespace antigrasp {

using SayFn = std::function<void(const std::string& line)>;

struct JoinOptions {
  // What has to be the same in all processes: program and settings, a line each ("version 1.2").
  std::vector<std::string> same;
  SayFn say;                                          // who waits for whom
  std::function<void()> pause;                        // called while waiting; may throw Interrupted
  std::function<void(std::uint16_t port)> listening;  // rank 0, once it does
  double patience_seconds = 600.0;                    // for the others, at the beginning
  double lost_after_seconds = 30.0;                   // without a sign of life
};

// The processes of a job: what one knows is told to the others. On LibTorch's c10d: a TCPStore,
// where rank 0 listens, and Gloo between all. All ranks must call the collective members (All*,
// FromLeader*) in the same order. RuntimeFailure where another process is gone; a process that is
// stuck in the middle of one is ended then (exit code 1), after a line to standard error.
class RankGroup {
 public:
  // Waits for all; InputError where `same` differs, on every rank, naming the first that does.
  static std::unique_ptr<RankGroup> Join(const Launch& launch, const JoinOptions& options);
  virtual ~RankGroup() = default;

  virtual int rank() const = 0;
  virtual int size() const = 0;
  bool leads() const { return rank() == 0; }

  // mine: of one shape and type on all ranks, on the CPU. Rank r's is item r.
  std::vector<torch::Tensor> All(const torch::Tensor& mine) { return AllOfFirst(size(), mine); }
  // The same among ranks 0 to ranks - 1, which alone call it.
  virtual std::vector<torch::Tensor> AllOfFirst(int ranks, const torch::Tensor& mine) = 0;
  // slices: [ranks, ...], item r for rank r; what comes back has what rank r sent as item r. Among
  // ranks 0 to ranks - 1, which alone call it.
  virtual torch::Tensor ToEachOfFirst(int ranks, const torch::Tensor& slices) = 0;
  // Rank 0's tensor, on all ranks; others hand in one of the same shape and type to be filled.
  virtual void FromLeader(torch::Tensor* tensor) = 0;
  std::string TextFromLeader(const std::string& text);  // any bytes
  torch::Tensor TensorFromLeader(
      const torch::Tensor& tensor);  // any shape; one float or int64 type

  // Takes the next `count` numbers of a counter that all share: the first of them.
  virtual std::int64_t TakeNext(const std::string& counter, std::int64_t count) = 0;
  // Bytes for whoever asks; asking waits, and takes them away.
  virtual void Put(const std::string& name, const std::string& bytes) = 0;
  virtual std::string Wait(const std::string& name) = 0;
  virtual bool Has(const std::string& name) = 0;  // whether Wait would not wait

  // "sent 12.3 MB in 456 messages": what a job costs the network, by this rank.
  std::string SentText() const;

 protected:
  void Count(std::int64_t bytes);

 private:
  std::int64_t bytes_sent_ = 0, messages_ = 0;
};

// Whether this build has what RankGroup needs (libgloo-dev).
bool CanJoin();

}  // namespace antigrasp
