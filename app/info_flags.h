#pragma once

#include <CLI/App.hpp>
#include <memory>
#include <string>

namespace antigrasp {

// The command line of `info`, which both programs have (network_commands.h).
struct InfoFlags {
  std::string path;
  bool csv = false;
  std::string control;  // folder of a run; empty: none given

  // InputError when a table was asked for, of something that has none.
  void RefuseTable() const;
};

// Adds the command; `describe` is called after parsing.
void AddInfo(CLI::App* app, void (*describe)(const InfoFlags& flags));

}  // namespace antigrasp
