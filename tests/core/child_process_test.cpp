#include "antigrasp/core/child_process.h"

#include <gtest/gtest.h>

namespace antigrasp {
namespace {

ChildEnd Shell(const std::string& script) { return RunChild("/bin/sh", {"-c", script}); }

TEST(RunChild, TellsHowAProgramEnded) {
  const ChildEnd good = Shell("exit 0"), bad = Shell("exit 3");
  EXPECT_EQ(good.code, 0);
  EXPECT_EQ(good.text, "");
  EXPECT_EQ(bad.code, 3);
  EXPECT_EQ(bad.text, "exit code 3");
}

TEST(RunChild, ASignalIsNoExitCode) {
  const ChildEnd end = Shell("kill -ILL $$");
  EXPECT_EQ(end.code, -1);
  EXPECT_EQ(end.text, "signal 4 (Illegal instruction)");
}

TEST(RunChild, AProgramThatIsNotThereIsNamedAsSuch) {
  const ChildEnd end = RunChild("/nonexistent/antigrasp-networks", {"doctor"});
  EXPECT_EQ(end.code, -1);
  EXPECT_EQ(end.text, "cannot be started (No such file or directory)");
}

TEST(RunChild, PassesArgumentsInTheirOrder) {
  EXPECT_EQ(RunChild("/bin/sh", {"-c", "[ \"$1$2\" = 'a bc' ]", "sh", "a b", "c"}).code, 0);
  EXPECT_EQ(RunChild("/bin/sh", {"-c", "[ \"$1$2\" = 'a bc' ]", "sh", "c", "a b"}).code, 1);
}

}  // namespace
}  // namespace antigrasp
