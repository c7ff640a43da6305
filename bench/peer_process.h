#pragma once

#include <sys/types.h>

#include <cstdio>
#include <string>
#include <vector>

namespace antigrasp::bench {

// A program that does one piece of work for each line it reads and answers each with a line, after
// a first line "ready".
class PeerProcess {
 public:
  explicit PeerProcess(const std::vector<std::string>& command);
  ~PeerProcess();  // ends the program
  PeerProcess(const PeerProcess&) = delete;
  PeerProcess& operator=(const PeerProcess&) = delete;

  bool ready() const { return ready_; }  // false: the program is missing or gave up
  void Work();                           // one line there, one line back

 private:
  bool ReadLine(const char* expected);

  pid_t pid_ = -1;
  FILE* requests_ = nullptr;
  FILE* answers_ = nullptr;
  bool ready_ = false;
};

}  // namespace antigrasp::bench
