#pragma once

#include <sys/types.h>

#include <functional>

namespace antigrasp::shapes {

// A process of its own that does `work` and then lives on until it is killed. Made when the work is
// done; a failed one (an exception) is not `alive`.
class ChildProcess {
 public:
  explicit ChildProcess(const std::function<void()>& work);
  ~ChildProcess() { Kill(); }
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  bool alive() const { return alive_; }
  pid_t pid() const { return pid_; }
  void Kill();  // without a warning, as the system does it when memory runs out

 private:
  pid_t pid_ = -1;
  bool alive_ = false;
};

}  // namespace antigrasp::shapes
