#include "antigrasp/models/named_tensors.h"

#include <gtest/gtest.h>
#include <torch/types.h>

#include <limits>

#include "antigrasp/core/error.h"

namespace antigrasp {
namespace {

std::string Refusal(const NamedTensors& wanted, const NamedTensors& stored) {
  try {
    TakeTensors(stored, "here.pt", wanted);
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

TEST(NamedTensors, AreTakenByNameAndHalfPrecisionAsFloat) {
  const torch::Tensor a = torch::zeros({2}), b = torch::zeros({2}),
                      n = torch::zeros({}, torch::kLong);
  // Numbers that a half holds.
  EXPECT_EQ(Refusal({{"a", a}, {"part/b", b}, {"n", n}},
                    {{"part/b", torch::tensor({3.5F, -4.0F}).to(torch::kHalf)},
                     {"a", torch::tensor({0.1F, 2.0F})},
                     {"n", torch::tensor(std::int64_t{9})}}),
            "none");
  EXPECT_TRUE(torch::equal(a, torch::tensor({0.1F, 2.0F})));
  EXPECT_TRUE(torch::equal(b, torch::tensor({3.5F, -4.0F})));
  EXPECT_EQ(n.item<std::int64_t>(), 9);
}

TEST(NamedTensors, ThatDoNotFitAreRefusedAndThenNothingChanges) {
  const torch::Tensor a = torch::zeros({2}), half = torch::zeros({2}, torch::kHalf);
  const torch::Tensor good = torch::ones({2});
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const NamedTensors wanted = {{"a", a}, {"b", torch::zeros({2})}};
  const auto refused = [&](const NamedTensors& tensors, const torch::Tensor& b, const char* why) {
    const std::string message = Refusal(tensors, {{"a", good}, {"b", b}});
    EXPECT_NE(message.find(why), std::string::npos) << message;
    EXPECT_NE(message.find("here.pt"), std::string::npos) << message;
    EXPECT_TRUE(torch::equal(a, torch::zeros({2})));
  };
  refused(wanted, torch::ones({3}), "b is Float [3]");
  refused(wanted, torch::ones({2}, torch::kDouble), "b is Double [2]");
  refused(wanted, torch::tensor({1.0F, nan}), "b is damaged");
  refused({{"a", a}, {"b", half}}, good, "b is Float [2]");
  refused({{"a", a}, {"c", half}}, good, "no tensor c");
}

}  // namespace
}  // namespace antigrasp
