#pragma once

#include <torch/types.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "antigrasp/core/launch.h"

namespace antigrasp {

using SayFn = std::function<void(const std::string& line)>;

// What a rank failed with before it met the others.
struct EarlyFailure {
  int exit_code = 1;
  std::string line;
};

struct JoinOptions {
  // What has to be the same in all processes: program and settings, a line each ("version 1.2").
  std::vector<std::string> same;
  SayFn say;                                          // who waits for whom
  std::function<void()> pause;                        // called while waiting; may throw Interrupted
  std::function<void(std::uint16_t port)> listening;  // rank 0, once it does
  std::optional<EarlyFailure> failure;                // which the others are to know of
};

// The counter (RankGroup::TakeNext) whose first number is taken by the rank that says what all of
// them end with.
inline constexpr const char* kSaid = "said";

// The processes of a job: what one knows is told to the others. On LibTorch's c10d: a TCPStore,
// where rank 0 listens, and Gloo between all. All ranks must call the collective members (All*,
// FromLeader*) in the same order. Where another process is gone, one of them says so, and all leave
// by SaidElsewhere; a process that is stuck in the middle of a call is ended (exit code 1).
class RankGroup {
 public:
  // Waits for all. SaidElsewhere where `same` differs, which rank 0 has said, naming the first rank
  // that does, and where a rank has begun with a failure, which the first of those has said.
  static std::unique_ptr<RankGroup> Join(const Launch& launch, const JoinOptions& options);
  virtual ~RankGroup() = default;

  virtual int rank() const = 0;
  virtual int size() const = 0;
  bool leads() const { return rank() == 0; }

  // mine: of one shape and type on ranks 0 to ranks - 1, which alone call it, on the CPU. Rank r's
  // is item r.
  virtual std::vector<torch::Tensor> AllOfFirst(int ranks, const torch::Tensor& mine) = 0;
  // slices: [ranks, ...], item r for rank r; what comes back has what rank r sent as item r. Among
  // ranks 0 to ranks - 1, which alone call it.
  virtual torch::Tensor ToEachOfFirst(int ranks, const torch::Tensor& slices) = 0;
  // Rank 0's tensor, on all ranks; others hand in one of the same shape and type to be filled.
  virtual void FromLeader(torch::Tensor* tensor) = 0;
  // What rank 0 takes from `rank` (TakeFrom) and that one gives (GiveLeader): of one shape and
  // type, contiguous, on the CPU. No copies are made.
  virtual void GiveLeader(const torch::Tensor& tensor) = 0;
  virtual void TakeFrom(int rank, torch::Tensor* tensor) = 0;
  std::string TextFromLeader(const std::string& text);  // any bytes
  torch::Tensor TensorFromLeader(
      const torch::Tensor& tensor);  // any shape; one float or int64 type

  // Takes the next `count` numbers of a counter that all share: the first of them.
  virtual std::int64_t TakeNext(const std::string& counter, std::int64_t count) = 0;
  // Bytes for whoever asks; asking waits, and takes them away.
  virtual void Put(const std::string& name, const std::string& bytes) = 0;
  virtual std::string Wait(const std::string& name) = 0;
  virtual bool Has(const std::string& name) = 0;  // whether Wait would not wait

  // Of another rank than 0: from here on it misses nobody, and nobody misses it.
  virtual void Leave() {}

  static std::string CounterKey(const std::string& counter) { return "next/" + counter; }

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
