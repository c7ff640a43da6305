#include "antigrasp/ranks/rank_group.h"

#include <algorithm>
#include <cstdio>

#include "antigrasp/core/error.h"

namespace antigrasp {
namespace {

constexpr std::int64_t kMostBytes = std::int64_t{1} << 34;  // of one tensor or text

// Shape and type as numbers: [type, dimensions, sizes...].
torch::Tensor Outline(const torch::Tensor& tensor) {
  torch::Tensor outline = torch::zeros({10}, torch::kLong);
  if (!tensor.defined()) return outline;
  outline[0] = static_cast<std::int64_t>(tensor.scalar_type());
  outline[1] = tensor.dim();
  for (std::int64_t i = 0; i < tensor.dim(); ++i) outline[i + 2] = tensor.size(i);
  return outline;
}

torch::Tensor EmptyLike(const torch::Tensor& outline) {
  const auto number = [&](std::int64_t i) { return outline[i].item<std::int64_t>(); };
  const auto type = static_cast<at::ScalarType>(number(0));
  const bool known = type == at::kFloat || type == at::kDouble || type == at::kHalf ||
                     type == at::kLong || type == at::kByte;
  std::vector<std::int64_t> sizes;
  double bytes = 8.0;
  bool fits = known && number(1) >= 0 && number(1) <= 8;
  for (std::int64_t i = 0; fits && i < number(1); ++i) {
    sizes.push_back(number(i + 2));
    bytes *= static_cast<double>(sizes.back());
    fits = sizes.back() >= 0 && bytes <= static_cast<double>(kMostBytes);
  }
  if (!fits) throw RuntimeFailure("rank 0 sent a tensor of a type or size that is none");
  return torch::empty(sizes, type);
}

}  // namespace

void RankGroup::Count(std::int64_t bytes) {
  bytes_sent_ += bytes;
  ++messages_;
}

std::string RankGroup::SentText() const {
  char text[80];
  std::snprintf(text, sizeof text, "sent %.1f MB in %lld messages", 1e-6 * double(bytes_sent_),
                static_cast<long long>(messages_));
  return text;
}

torch::Tensor RankGroup::TensorFromLeader(const torch::Tensor& tensor) {
  torch::Tensor outline = Outline(leads() ? tensor : torch::Tensor());
  FromLeader(&outline);
  torch::Tensor filled = leads() ? tensor.cpu().contiguous() : EmptyLike(outline);
  if (filled.numel() > 0) FromLeader(&filled);
  return filled;
}

std::string RankGroup::TextFromLeader(const std::string& text) {
  torch::Tensor bytes;
  if (leads()) {
    bytes = torch::empty({static_cast<std::int64_t>(text.size())}, torch::kByte);
    std::copy(text.begin(), text.end(), bytes.data_ptr<std::uint8_t>());
  }
  bytes = TensorFromLeader(bytes);
  if (bytes.scalar_type() != at::kByte) throw RuntimeFailure("rank 0 sent no text");
  const std::uint8_t* begin = bytes.data_ptr<std::uint8_t>();
  return {begin, begin + bytes.numel()};
}

#ifndef ANTIGRASP_HAS_GLOO
bool CanJoin() { return false; }
std::unique_ptr<RankGroup> RankGroup::Join(const Launch&, const JoinOptions&) {
  throw RuntimeFailure("this build knows no other processes: it was made without libgloo-dev");
}
#endif

}  // namespace antigrasp
