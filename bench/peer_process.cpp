#include "bench/peer_process.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>

#include "antigrasp/core/error.h"

namespace antigrasp::bench {

PeerProcess::PeerProcess(const std::vector<std::string>& command) {
  std::vector<char*> arguments;
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  std::array<int, 2> to{}, from{};
  if (pipe2(to.data(), O_CLOEXEC) != 0 || pipe2(from.data(), O_CLOEXEC) != 0) return;
  pid_ = fork();
  if (pid_ == 0) {
    dup2(to[0], STDIN_FILENO);
    dup2(from[1], STDOUT_FILENO);
    dup2(open("/dev/null", O_WRONLY), STDERR_FILENO);
    execvp(arguments[0], arguments.data());
    _exit(127);
  }
  close(to[0]);
  close(from[1]);
  requests_ = fdopen(to[1], "w");
  answers_ = fdopen(from[0], "r");
  ready_ = pid_ > 0 && ReadLine("ready\n");
}

PeerProcess::~PeerProcess() {
  if (requests_ != nullptr) std::fclose(requests_);
  if (answers_ != nullptr) std::fclose(answers_);
  if (pid_ > 0) waitpid(pid_, nullptr, 0);
}

bool PeerProcess::ReadLine(const char* expected) {
  std::array<char, 16> line{};
  return std::fgets(line.data(), line.size(), answers_) != nullptr &&
         std::string(line.data()) == expected;
}

void PeerProcess::Work() {
  std::fputs("\n", requests_);
  std::fflush(requests_);
  if (!ReadLine("done\n")) throw RuntimeFailure("the peer process ended before its work was done");
}

}  // namespace antigrasp::bench
