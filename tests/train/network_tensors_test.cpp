#include "antigrasp/train/network_tensors.h"

#include <gtest/gtest.h>
#include <torch/types.h>

namespace antigrasp {
namespace {

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
