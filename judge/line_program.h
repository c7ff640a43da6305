#pragma once

#include <sys/types.h>

#include <optional>
#include <string>
#include <string_view>

namespace antigrasp {

// A program of somebody else that is talked to in lines: ours to its standard input, its own from
// its standard output; what it says on standard error goes to ours. It runs under the shell in a
// process group of its own, so that a Ctrl-C is ours alone and nothing that it started outlives it.
// POSIX pipes; reading and writing take turns, so that neither side can block the other.
class LineProgram {
 public:
  // RuntimeFailure when no process can be made. A command that does not exist ends at once with
  // exit code 127.
  explicit LineProgram(const std::string& command);
  ~LineProgram();  // closes its input; one that has not ended after two seconds is killed
  LineProgram(const LineProgram&) = delete;
  LineProgram& operator=(const LineProgram&) = delete;

  void Send(std::string_view text) { unsent_ += text; }  // during Wait
  enum class Event { kLine, kNothing, kEnded };
  // Until a line came (without its end), so many seconds went by, or no line can come any more.
  Event Wait(double seconds, std::string* line);
  // After kEnded: the shell's exit code, 128 and the number for one that a signal ended.
  int exit_code() const { return exit_code_; }

 private:
  bool TakeLine(std::string* line);
  void Write();
  void Read();
  bool Reap(double seconds);  // whether it has ended, waited for so long
  void Kill();

  pid_t pid_ = -1;
  int in_ = -1, out_ = -1;  // -1: closed
  std::string unsent_, received_;
  int exit_code_ = 0;
};

}  // namespace antigrasp
