#pragma once

#include <torch/types.h>

#include <cstdint>

namespace antigrasp {

// Who computes which parts of a batch (gan.micro_batches): rank r of n those with part % n = r.
class BatchShare {
 public:
  virtual ~BatchShare() = default;
  virtual int rank() const = 0;
  virtual int size() const = 0;
  // rows: [parts of this rank, P] float32 on the CPU, in the order of the parts. Their sum over all
  // `parts` parts of all ranks, added in the order of the parts: the same bits on every rank, and
  // for any number of ranks. [P].
  virtual torch::Tensor SumInOrder(const torch::Tensor& rows, std::int64_t parts) = 0;
};

// One process: all parts are its own.
class WholeBatch : public BatchShare {
 public:
  int rank() const override { return 0; }
  int size() const override { return 1; }
  torch::Tensor SumInOrder(const torch::Tensor& rows, std::int64_t parts) override;
};

}  // namespace antigrasp
