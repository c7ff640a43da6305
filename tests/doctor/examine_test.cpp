#include "antigrasp/doctor/examine.h"

#include <gtest/gtest.h>

#include "antigrasp/core/error.h"
#include "antigrasp/core/version.h"
#include "antigrasp/doctor/build_facts.h"

namespace antigrasp {
namespace {

// What is printed, and behind it the failure.
std::string Examined(const ChildEnd& networks) {
  SilentObserver nobody;
  std::string printed;
  try {
    Examine([&](const std::string& lines) { printed += lines; },
            [&] {
              printed += "(networks)\n";
              return networks;
            },
            &nobody);
  } catch (const RuntimeFailure& failure) {
    printed += failure.what();
  }
  return printed;
}

TEST(Examine, PrintsFactsAndSelfTestBeforeTheNetworksPrintTheirs) {
  const std::string printed = Examined({});
  std::size_t place = 0;
  for (const char* begin : {"antigrasp         ", "\nsystem            ", "\ncompiler          ",
                            "\nlibraries         ", "\ninstruction set   ", "\nthreads           ",
                            "\nphysics           ", "\nreport            ", "\nformats           ",
                            "\nself-test         made, remeshed, scored, perturbed"}) {
    place = printed.find(begin, place);
    ASSERT_NE(place, std::string::npos) << begin << printed;
  }
  EXPECT_TRUE(printed.starts_with("antigrasp         " + ProgramVersion())) << printed;
  EXPECT_TRUE(printed.ends_with(BuiltWithNetworks() ? ": the expected bytes\n(networks)\n"
                                                    : ": the expected bytes\n"))
      << printed;
}

TEST(Examine, FailsWhenTheNetworksDo) {
  if (!BuiltWithNetworks()) GTEST_SKIP() << "a build without networks";
  EXPECT_TRUE(Examined({kOtherBytes, "exit code 3"})
                  .ends_with("(networks)\nthe self-test gave other bytes than expected (above)"));
  EXPECT_TRUE(Examined({127, "exit code 127"})
                  .ends_with("(networks)\nantigrasp-networks failed: exit code 127"));
  EXPECT_TRUE(Examined({-1, "signal 4 (Illegal instruction)"})
                  .ends_with("antigrasp-networks failed: signal 4 (Illegal instruction)"));
}

TEST(FactLine, HasItsSecondColumnAtTheNineteenthCharacter) {
  EXPECT_EQ(FactLine("threads", "2"), "threads           2\n");
  EXPECT_EQ(FactLine("a very long name of it", "2"), "a very long name of it 2\n");
}

}  // namespace
}  // namespace antigrasp
