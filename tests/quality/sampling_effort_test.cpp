#include "antigrasp/quality/sampling_effort.h"

#include <gtest/gtest.h>

namespace antigrasp {
namespace {

TEST(SamplingEffort, UpToAHundredObjectsTakeAThousandGraspsEach) {
  for (const std::int64_t objects : {1, 30, 100}) {
    MetricOptions options;
    RaiseEffortForFew(objects, &options);
    EXPECT_EQ(options.num_grasps, 1000) << objects;
    EXPECT_EQ(options.max_attempts, 40000) << objects;  // 4000 are for 100
  }
  EXPECT_EQ(EffortText(1,
                       [] {
                         MetricOptions options;
                         RaiseEffortForFew(1, &options);
                         return options;
                       }()),
            "1000 grasps an object, as there are at most 100 objects");
}

TEST(SamplingEffort, MoreObjectsAndMoreGraspsStayAsTheyAre) {
  MetricOptions options;
  RaiseEffortForFew(101, &options);
  EXPECT_EQ(options.num_grasps, 100);
  EXPECT_EQ(options.max_attempts, 4000);
  EXPECT_EQ(EffortText(101, options), "100 grasps an object, as there are more than 100 objects");
  options.num_grasps = 1500;
  options.max_attempts = 1'000'000'000;
  RaiseEffortForFew(1, &options);
  EXPECT_EQ(options.num_grasps, 1500);
  options.num_grasps = 1;  // a thousand times more would not fit
  RaiseEffortForFew(1, &options);
  EXPECT_EQ(options.max_attempts, 1'000'000'000);
}

TEST(SamplingEffort, EveryOtherConstantIsThePresets) {
  MetricOptions options;
  RaiseEffortForFew(1, &options);
  options.num_grasps = 100;
  options.max_attempts = 4000;
  EXPECT_EQ(MetricToml(options, 1), MetricToml(MetricOptions(), 1));
}

}  // namespace
}  // namespace antigrasp
