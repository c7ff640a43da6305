#include "antigrasp/judge/line_program.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <ctime>
#include <thread>
#include <vector>

#include "antigrasp/core/error.h"
#include "antigrasp/core/launch.h"

namespace antigrasp {
namespace {

using Clock = std::chrono::steady_clock;

// A longer line is no answer: it is cut, so that a program that never ends one takes no memory.
constexpr std::size_t kLongestLine = 1 << 20;
constexpr double kPatience = 2.0;  // seconds from the end of its input to its own

[[noreturn]] void Fail(const std::string& what, int error) {
  throw RuntimeFailure(what + ": " + std::strerror(error));
}

void CloseEnd(int* end) {
  if (*end >= 0) close(*end);
  *end = -1;
}

// Ends that no other child gets, or it would keep them open.
std::array<int, 2> MakePipe() {
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) Fail("a pipe", errno);
  for (const int end : ends) fcntl(end, F_SETFD, FD_CLOEXEC);
  return ends;
}

// A write to a program that has gone raises SIGPIPE, which would end ours.
class NoPipeSignal {
 public:
  NoPipeSignal() {
    sigemptyset(&pipe_);
    sigaddset(&pipe_, SIGPIPE);
    sigset_t pending;
    sigpending(&pending);
    was_pending_ = sigismember(&pending, SIGPIPE) == 1;
    pthread_sigmask(SIG_BLOCK, &pipe_, &before_);
  }
  ~NoPipeSignal() {
    const timespec now = {0, 0};
    while (!was_pending_ && sigtimedwait(&pipe_, nullptr, &now) > 0) {
    }
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }
  NoPipeSignal(const NoPipeSignal&) = delete;
  NoPipeSignal& operator=(const NoPipeSignal&) = delete;

 private:
  sigset_t pipe_, before_;
  bool was_pending_;
};

}  // namespace

LineProgram::LineProgram(const std::string& command) {
  std::array<int, 2> to = MakePipe(), from = MakePipe();
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, to[0], STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, from[1], STDOUT_FILENO);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setpgroup(&attributes, 0);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  std::string shell = "sh", option = "-c", text = command;
  std::array<char*, 4> arguments = {shell.data(), option.data(), text.data(), nullptr};
  std::vector<std::string> variables = EnvironmentAlone();
  std::vector<char*> environment;
  for (std::string& variable : variables) environment.push_back(variable.data());
  environment.push_back(nullptr);
  const int error =
      posix_spawn(&pid_, "/bin/sh", &actions, &attributes, arguments.data(), environment.data());
  posix_spawn_file_actions_destroy(&actions);
  posix_spawnattr_destroy(&attributes);
  CloseEnd(&to[0]);
  CloseEnd(&from[1]);
  in_ = to[1];
  out_ = from[0];
  if (error != 0) {
    pid_ = -1;
    CloseEnd(&in_);
    CloseEnd(&out_);
    Fail(command, error);
  }
  for (const int end : {in_, out_}) fcntl(end, F_SETFL, O_NONBLOCK);
}

LineProgram::~LineProgram() {
  CloseEnd(&in_);
  CloseEnd(&out_);
  if (!Reap(kPatience)) Kill();
}

void LineProgram::Kill() {
  if (pid_ < 0) return;
  kill(-pid_, SIGKILL);
  Reap(kPatience);
}

bool LineProgram::Reap(double seconds) {
  const auto end = Clock::now() + std::chrono::duration<double>(seconds);
  while (pid_ >= 0) {
    int status = 0;
    const pid_t reaped = waitpid(pid_, &status, WNOHANG);
    if (reaped == pid_ || (reaped < 0 && errno != EINTR)) {
      exit_code_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
      kill(-pid_, SIGKILL);  // what it left behind in its group
      pid_ = -1;
    } else if (Clock::now() >= end) {
      return false;
    } else {
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
  }
  return true;
}

bool LineProgram::TakeLine(std::string* line) {
  const std::size_t end = received_.find('\n');
  if (end == std::string::npos && received_.size() < kLongestLine) return false;
  *line = received_.substr(0, end);
  received_.erase(0, end == std::string::npos ? end : end + 1);
  return true;
}

void LineProgram::Write() {
  const NoPipeSignal guard;
  const ssize_t count = write(in_, unsent_.data(), unsent_.size());
  if (count > 0) unsent_.erase(0, static_cast<std::size_t>(count));
  if (count < 0 && errno != EAGAIN && errno != EINTR) {  // it reads no more; it may still answer
    CloseEnd(&in_);
    unsent_.clear();
  }
}

void LineProgram::Read() {
  std::array<char, 1 << 16> buffer;
  const ssize_t count = read(out_, buffer.data(), buffer.size());
  if (count > 0) received_.append(buffer.data(), static_cast<std::size_t>(count));
  if (count == 0 || (count < 0 && errno != EAGAIN && errno != EINTR)) CloseEnd(&out_);
}

LineProgram::Event LineProgram::Wait(double seconds, std::string* line) {
  const auto end = Clock::now() + std::chrono::duration<double>(seconds);
  while (true) {
    if (TakeLine(line)) return Event::kLine;
    if (out_ < 0) {
      if (!Reap(kPatience)) Kill();
      return Event::kEnded;
    }
    const double left = std::chrono::duration<double>(end - Clock::now()).count();
    if (left <= 0.0) return Event::kNothing;
    const bool writes = in_ >= 0 && !unsent_.empty();
    std::array<pollfd, 2> ends = {pollfd{out_, POLLIN, 0}, pollfd{in_, POLLOUT, 0}};
    const int ready = poll(ends.data(), writes ? 2 : 1, static_cast<int>(1e3 * left) + 1);
    if (ready < 0 && errno == EINTR) return Event::kNothing;  // the caller looks why
    if (writes && ends[1].revents != 0) Write();
    if (ends[0].revents != 0) Read();
  }
}

}  // namespace antigrasp
