#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace antigrasp {

// How a program ended.
struct ChildEnd {
  int code = 0;      // its exit code; -1 when it has none
  std::string text;  // "" for 0; "exit code 3", "signal 4 (Illegal instruction)", "cannot be
                     // started (No such file or directory)"
};

// Of what waitpid() says of a process that has ended.
ChildEnd EndOf(int status);

// Runs a program to its end, with this process's environment and standard streams.
ChildEnd RunChild(const std::filesystem::path& program, const std::vector<std::string>& arguments);

}  // namespace antigrasp
