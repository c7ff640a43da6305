#include "antigrasp/train/batch_share.h"

#include "antigrasp/core/check.h"

namespace antigrasp {

torch::Tensor WholeBatch::SumInOrder(const torch::Tensor& rows, std::int64_t parts) {
  AG_CHECK(rows.dim() == 2 && rows.size(0) == parts, "a row for every part");
  const torch::NoGradGuard no_grad;
  torch::Tensor sum = rows[0].clone();
  for (std::int64_t part = 1; part < parts; ++part) sum.add_(rows[part]);
  return sum;
}

}  // namespace antigrasp
