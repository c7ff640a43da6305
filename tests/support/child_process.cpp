#include "tests/support/child_process.h"

#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>

namespace antigrasp::shapes {

ChildProcess::ChildProcess(const std::function<void()>& work) {
  std::array<int, 2> done{};
  if (::pipe(done.data()) != 0) return;
  pid_ = ::fork();
  if (pid_ == 0) {
    try {
      work();
    } catch (...) {
      ::_exit(1);
    }
    const char byte = 1;
    if (::write(done[1], &byte, 1) == 1) ::pause();
    ::_exit(1);
  }
  ::close(done[1]);
  char byte = 0;
  alive_ = ::read(done[0], &byte, 1) == 1;
  ::close(done[0]);
}

void ChildProcess::Kill() {
  if (pid_ <= 0) return;
  ::kill(pid_, SIGKILL);
  ::waitpid(pid_, nullptr, 0);
  pid_ = -1;
  alive_ = false;
}

}  // namespace antigrasp::shapes
