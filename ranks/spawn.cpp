#include "antigrasp/ranks/spawn.h"

#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <cstring>
#include <string>
#include <thread>

#include "antigrasp/core/error.h"

namespace antigrasp {

SpawnedRanks::SpawnedRanks(int processes) : processes_(processes) {
  const std::string count = std::to_string(processes);
  setenv("WORLD_SIZE", count.c_str(), 1);
  setenv("LOCAL_WORLD_SIZE", count.c_str(), 1);
  setenv("RANK", "0", 1);
  setenv("MASTER_ADDR", "127.0.0.1", 1);
  setenv("MASTER_PORT", "0", 1);
  unsetenv("TORCHELASTIC_USE_AGENT_STORE");
  setenv("GLOG_minloglevel", "3", 0);  // of the others: c10d logs every try to reach rank 0
}

void SpawnedRanks::Start(std::uint16_t port, char** arguments) {
  setenv("MASTER_PORT", std::to_string(port).c_str(), 1);
  for (int rank = 1; rank < processes_; ++rank) {
    setenv("RANK", std::to_string(rank).c_str(), 1);
    pid_t child = 0;
    // A group of their own: the terminal's Ctrl-C is rank 0's alone.
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
    const int error =
        posix_spawn(&child, "/proc/self/exe", nullptr, &attributes, arguments, environ);
    posix_spawnattr_destroy(&attributes);
    if (error != 0) {
      throw RuntimeFailure("rank " + std::to_string(rank) +
                           " cannot be started: " + std::strerror(error));
    }
    ranks_.push_back(child);
  }
  setenv("RANK", "0", 1);
}

void SpawnedRanks::Check() {
  for (std::size_t i = 0; i < ranks_.size(); ++i) {
    // Left to be waited for by the destructor.
    siginfo_t ended{};
    const auto id = static_cast<id_t>(ranks_[i]);
    if (waitid(P_PID, id, &ended, WEXITED | WNOHANG | WNOWAIT) == 0 && ended.si_pid != 0) {
      throw RuntimeFailure("rank " + std::to_string(i + 1) + " ended before the work began");
    }
  }
}

SpawnedRanks::~SpawnedRanks() {
  const auto start = std::chrono::steady_clock::now();
  for (const pid_t rank : ranks_) {
    while (waitpid(rank, nullptr, WNOHANG) == 0) {
      if (std::chrono::steady_clock::now() - start > std::chrono::seconds(10)) kill(rank, SIGKILL);
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
  }
}

}  // namespace antigrasp
