#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <string>

// The binary as a user meets it.
namespace antigrasp::cli {

struct Outcome {
  int code = -1;
  std::string text;  // standard output and error
};

inline Outcome Shell(const std::string& command) {
  Outcome outcome;
  FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  std::array<char, 4096> buffer;
  while (const std::size_t n = fread(buffer.data(), 1, buffer.size(), pipe)) {
    outcome.text.append(buffer.data(), n);
  }
  const int status = pclose(pipe);
  outcome.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return outcome;
}

inline Outcome Antigrasp(const std::string& arguments) {
  return Shell(std::string(ANTIGRASP_BINARY) + " " + arguments);
}

// Exit code 2, one line that begins with the program's name and holds `part`.
inline void ExpectRefused(const std::string& arguments, const std::string& part) {
  const Outcome outcome = Antigrasp(arguments);
  EXPECT_EQ(outcome.code, 2) << arguments << "\n" << outcome.text;
  EXPECT_NE(outcome.text.find(part), std::string::npos) << arguments << "\n" << outcome.text;
  EXPECT_EQ(std::count(outcome.text.begin(), outcome.text.end(), '\n'), 1) << outcome.text;
  EXPECT_TRUE(outcome.text.starts_with("antigrasp: ")) << outcome.text;
}

}  // namespace antigrasp::cli
