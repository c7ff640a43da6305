#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

#include "antigrasp/core/child_process.h"

namespace antigrasp {

// A program that works beside this one: without input, unheard, with none of this process's open
// files, in a group of its own, so that Ctrl-C is this process's alone. It is told to stop
// (SIGTERM) when this object goes and, on Linux, when the thread that made it ends, by SIGKILL too.
class BackgroundProcess {
 public:
  // words: as main() gets them, its own name first. RuntimeFailure where no process can be made. A
  // program that is not there ends at once, with code 127.
  BackgroundProcess(const std::filesystem::path& program, const std::vector<std::string>& words);
  ~BackgroundProcess();  // waits for it; one that does not end within 30 s is killed
  BackgroundProcess(const BackgroundProcess&) = delete;
  BackgroundProcess& operator=(const BackgroundProcess&) = delete;

  bool Ended();
  const ChildEnd& end() const { return end_; }  // how, once it has

 private:
  pid_t pid_ = -1;  // -1: waited for
  ChildEnd end_;
};

}  // namespace antigrasp
