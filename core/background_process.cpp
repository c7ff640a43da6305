#include "antigrasp/core/background_process.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <thread>

#include "antigrasp/core/error.h"

namespace antigrasp {
namespace {

using Clock = std::chrono::steady_clock;

// Between fork and exec: calls that are safe there alone.
[[noreturn]] void Become(const char* program, char* const* words, pid_t parent) {
  setpgid(0, 0);
#ifdef __linux__
  prctl(PR_SET_PDEATHSIG, SIGTERM);
#endif
  if (getppid() != parent) _exit(127);  // it went before it could be told
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
  const int none = open("/dev/null", O_RDWR);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) dup2(none, stream);
  execv(program, words);
  _exit(127);
}

}  // namespace

BackgroundProcess::BackgroundProcess(const std::filesystem::path& program,
                                     const std::vector<std::string>& arguments) {
  std::vector<char*> words{const_cast<char*>(program.c_str())};
  for (const std::string& argument : arguments)
    words.push_back(const_cast<char*>(argument.c_str()));
  words.push_back(nullptr);
  const pid_t parent = getpid();
  pid_ = fork();
  if (pid_ == 0) Become(program.c_str(), words.data(), parent);
  if (pid_ < 0) {
    throw RuntimeFailure(program.string() + " cannot be started: " + std::strerror(errno));
  }
}

bool BackgroundProcess::Ended() {
  if (pid_ < 0) return true;
  const pid_t reaped = waitpid(pid_, nullptr, WNOHANG);
  if (reaped == pid_ || (reaped < 0 && errno == ECHILD)) pid_ = -1;
  return pid_ < 0;
}

BackgroundProcess::~BackgroundProcess() {
  if (Ended()) return;
  kill(pid_, SIGTERM);
  const auto patience = Clock::now() + std::chrono::seconds(30);
  while (!Ended()) {
    if (Clock::now() > patience) kill(pid_, SIGKILL);
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

}  // namespace antigrasp
