#include "antigrasp/train/tensor_archive.h"

#include <gtest/gtest.h>
#include <torch/types.h>

#include <limits>

#include "antigrasp/core/error.h"
#include "antigrasp/train/network_tensors.h"
#include "tests/train/tiny_gan.h"

namespace antigrasp {
namespace {

std::string Refusal(const NamedTensors& wanted, const tiny_gan::Tensors& stored) {
  torch::serialize::InputArchive archive = tiny_gan::ArchiveOf(stored);
  try {
    ReadTensors(wanted, "here.pt", &archive);
  } catch (const InputError& error) {
    return error.what();
  }
  return "none";
}

TEST(TensorArchive, ReadsTensorsByNameAndHalfPrecisionAsFloat) {
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

TEST(TensorArchive, RefusesWhatDoesNotFitAndThenChangesNothing) {
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

TEST(NetworkTensors, AMixturesAndAnOptimisersPartsHaveTheirNames) {
  const LatentMixture mixture{torch::full({1}, 1.0), torch::full({1, 2}, 2.0),
                              torch::full({1, 2}, 3.0)};
  NamedTensors named;
  AppendMixture("z/", mixture, &named);
  const Adam adam({torch::zeros({1})}, 0.0, 0.5);
  adam.first_moments()[0].fill_(4.0);
  adam.second_moments()[0].fill_(5.0);
  adam.steps().fill_(6);
  AppendAdam("adam/", adam, &named);
  const std::vector<std::string> names = {"z/weights",    "z/means",       "z/deviations",
                                          "adam/first/0", "adam/second/0", "adam/steps"};
  ASSERT_EQ(named.size(), names.size());
  for (std::size_t i = 0; i < names.size(); ++i) {
    EXPECT_EQ(named[i].first, names[i]);
    EXPECT_EQ(named[i].second.flatten()[0].item<double>(), static_cast<double>(i + 1)) << names[i];
  }
}

}  // namespace
}  // namespace antigrasp
