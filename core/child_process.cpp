#include "antigrasp/core/child_process.h"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace antigrasp {

ChildEnd EndOf(int status) {
  if (WIFSIGNALED(status)) {
    const int signal = WTERMSIG(status);
    return {-1, "signal " + std::to_string(signal) + " (" + strsignal(signal) + ")"};
  }
  const int code = WEXITSTATUS(status);
  return {code, code == 0 ? "" : "exit code " + std::to_string(code)};
}

ChildEnd RunChild(const std::filesystem::path& program, const std::vector<std::string>& arguments) {
  std::vector<char*> words{const_cast<char*>(program.c_str())};
  for (const std::string& argument : arguments) {
    words.push_back(const_cast<char*>(argument.c_str()));
  }
  words.push_back(nullptr);
  pid_t child = 0;
  const int error = posix_spawn(&child, program.c_str(), nullptr, nullptr, words.data(), environ);
  if (error != 0) return {-1, std::string("cannot be started (") + std::strerror(error) + ")"};
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return EndOf(status);
}

}  // namespace antigrasp
