#include "antigrasp/doctor/self_test.h"

#include <gtest/gtest.h>

namespace antigrasp {
namespace {

// The bytes of Debian 12's compiler and libraries, on every x86-64 with AVX2.
TEST(SelfTest, GivesTheExpectedBytesOnAnyNumberOfThreads) {
  SilentObserver nobody;
  for (const int threads : {1, 3}) {
    const std::vector<SelfTestStep> steps = RunSelfTest(threads, &nobody);
    ASSERT_GE(steps.size(), 4u);
    for (const SelfTestStep& step : steps) {
      EXPECT_TRUE(step.ok()) << step.name << ", " << threads << " threads: " << SelfTestText(steps);
    }
  }
}

TEST(SelfTest, EveryStepHashesSomethingElse) {
  SilentObserver nobody;
  const std::vector<SelfTestStep> steps = RunSelfTest(0, &nobody);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    EXPECT_NE(steps[i].found, HashedBytes().Hash()) << steps[i].name << " hashes nothing";
    for (std::size_t j = 0; j < i; ++j) EXPECT_NE(steps[i].found, steps[j].found);
  }
}

TEST(HashedBytes, IsFnv1aOfTheBytesInTheirOrder) {
  EXPECT_EQ(HashedBytes().Hash(), 0xcbf29ce484222325u);  // its offset basis
  HashedBytes one, two;
  one.Add(std::vector<char>{'a'});
  EXPECT_EQ(one.Hash(), 0xaf63dc4c8601ec8cu);  // published test vector for "a"
  const std::int32_t numbers[] = {1, 2};
  two.Add(numbers, 2);
  HashedBytes turned;
  turned.Add(numbers + 1, 1);
  turned.Add(numbers, 1);
  EXPECT_NE(two.Hash(), turned.Hash());
}

TEST(SelfTestText, NamesWhatIsRightWrongAndUnknown) {
  const SelfTestStep right{"made", 7, 7}, wrong{"scored", 255, 16}, unknown{"tried", 10, {}};
  EXPECT_TRUE(AllOk({right, unknown}));
  EXPECT_FALSE(AllOk({right, wrong}));
  EXPECT_EQ(SelfTestText({right, {"remeshed", 8, 8}}), "made, remeshed: the expected bytes");
  EXPECT_EQ(SelfTestText({right, wrong}),
            "OTHER BYTES: scored 00000000000000ff, expected 0000000000000010; made: the expected "
            "bytes");
  EXPECT_EQ(SelfTestText({right, unknown}),
            "made: the expected bytes; no bytes are known for tried 000000000000000a");
}

}  // namespace
}  // namespace antigrasp
