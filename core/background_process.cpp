#include "antigrasp/core/background_process.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>
#ifdef __linux__
#include <linux/close_range.h>
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

// Between fork and exec: calls that are safe there alone. All signals are blocked meanwhile, so
// that one ends the process and does not only set a flag of ours that exec forgets.
[[noreturn]] void Become(const char* program, char* const* words, pid_t parent,
                         const sigset_t& signals) {
  setpgid(0, 0);
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
#ifdef __linux__
  prctl(PR_SET_PDEATHSIG, SIGTERM);
#endif
  if (getppid() != parent) _exit(127);  // it went before it could be told
  const int none = open("/dev/null", O_RDWR);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) dup2(none, stream);
#ifdef CLOSE_RANGE_CLOEXEC
  close_range(3, ~0U, CLOSE_RANGE_CLOEXEC);
#endif
  sigprocmask(SIG_SETMASK, &signals, nullptr);
  execv(program, words);
  _exit(127);
}

}  // namespace

BackgroundProcess::BackgroundProcess(const std::filesystem::path& program,
                                     const std::vector<std::string>& words) {
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  const pid_t parent = getpid();
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  pid_ = fork();
  if (pid_ == 0) Become(program.c_str(), arguments.data(), parent, before);
  const int error = errno;
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  if (pid_ < 0) {
    throw RuntimeFailure(program.string() + " cannot be started: " + std::strerror(error));
  }
}

bool BackgroundProcess::Ended() {
  if (pid_ < 0) return true;
  int status = 0;
  const pid_t reaped = waitpid(pid_, &status, WNOHANG);
  if (reaped == pid_) end_ = EndOf(status);
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
