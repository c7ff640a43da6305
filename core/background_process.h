#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

namespace antigrasp {

// A program that works beside this one: without input, unheard, in a group of its own, so that
// Ctrl-C is this process's alone. It is told to stop (SIGTERM) when this object goes and, on Linux,
// when the thread that made it ends, by SIGKILL too.
class BackgroundProcess {
 public:
  // RuntimeFailure where no process can be made. A program that is not there ends at once.
  BackgroundProcess(const std::filesystem::path& program,
                    const std::vector<std::string>& arguments);
  ~BackgroundProcess();  // waits for it; one that does not end within 30 s is killed
  BackgroundProcess(const BackgroundProcess&) = delete;
  BackgroundProcess& operator=(const BackgroundProcess&) = delete;

  bool Ended();

 private:
  pid_t pid_ = -1;  // -1: waited for
};

}  // namespace antigrasp
