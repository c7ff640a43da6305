#include "antigrasp/app/program.h"

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <cstdio>
#include <string>
#include <vector>

#include "antigrasp/app/console.h"
#include "antigrasp/core/exit_code.h"
#include "antigrasp/core/launch.h"
#include "antigrasp/core/nearest.h"
#include "antigrasp/core/version.h"

namespace antigrasp {
namespace {

// "antigrasp dataset import".
std::string FullName(const CLI::App& command) {
  const CLI::App* parent = command.get_parent();
  return (parent == nullptr ? "" : FullName(*parent) + " ") + command.get_name();
}

std::vector<std::string> CommandNames(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  return names;
}

std::vector<std::string> OptionNames(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    for (const std::string& name : option->get_snames()) names.push_back("-" + name);
  }
  return names;
}

[[noreturn]] void RefuseWord(const std::string& kind, const std::string& word, const CLI::App& in,
                             const std::vector<std::string>& known) {
  throw InputError("no " + kind + " " + word, FullName(in),
                   known.empty() ? "nothing behind it"
                                 : "a known " + kind + "; the nearest is " + Nearest(word, known));
}

void PrintHelp(const CLI::App& command) {
  // Not help(): that hands over to the subcommand in use, which may be "help".
  std::fputs(command.get_formatter()
                 ->make_help(&command, FullName(command), CLI::AppFormatMode::Normal)
                 .c_str(),
             stdout);
}

// The help of the command that these words lead to.
void PrintHelpOf(const CLI::App& app, const std::vector<std::string>& path) {
  const CLI::App* about = &app;
  for (const std::string& word : path) {
    const auto known =
        about->get_subcommands([&](const CLI::App* c) { return c->get_name() == word; });
    if (known.empty()) RefuseWord("command", word, *about, CommandNames(*about));
    about = known.front();
  }
  PrintHelp(*about);
}

// InputError for the first word that no command took, if there is one: a slip in a name, which is
// also why something may be missing.
void RefuseUnknownWord(const CLI::App& command) {
  for (const std::string& word : command.remaining()) {
    const bool is_option = word.size() > 1 && word.starts_with('-');
    if (is_option) {
      RefuseWord("option", word.substr(0, word.find('=')), command, OptionNames(command));
    }
    const std::vector<std::string> known = CommandNames(command);
    if (!known.empty() && command.get_subcommands().empty()) {
      RefuseWord("command", word, command, known);
    }
  }
  for (const CLI::App* used : command.get_subcommands()) RefuseUnknownWord(*used);
}

int Parse(int argc, char** argv, const std::function<void(CLI::App*)>& add_commands) {
  CLI::App app(
      "Designs objects that look ordinary and that a parallel-jaw gripper finds hard to grasp "
      "(Adversarial Grasp Objects, Wang et al. 2019)",
      "antigrasp");
  app.set_version_flag("--version", "antigrasp " + ProgramVersion() + " (" + ProgramCommit() + ")");
  app.require_subcommand(1);
  add_commands(&app);
  CLI::App* help = app.add_subcommand("help", "Show this, or the help of a command");
  std::vector<std::string> path;
  help->add_option("COMMAND", path, "command to explain, as: dataset import");
  help->callback([&] { PrintHelpOf(app, path); });
  if (argc == 1) {
    PrintHelp(app);
    return kExitOk;
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& success) {
    return app.exit(success);  // --help, --version
  } catch (const CLI::ParseError& error) {
    const bool by_a_word = dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr ||
                           dynamic_cast<const CLI::RequiredError*>(&error) != nullptr;
    if (by_a_word) RefuseUnknownWord(app);
    throw ToldInputError(std::string(error.what()) + "; see antigrasp help");
  }
  return kExitOk;
}

}  // namespace

int RunProgram(int argc, char** argv, const std::function<void(CLI::App*)>& add_commands,
               const SaysFn& says) {
  spdlog::set_default_logger(spdlog::stderr_color_mt("antigrasp"));
  spdlog::set_pattern("[%H:%M:%S] %^%v%$");
  if (!LeadsJob()) spdlog::set_level(spdlog::level::err);  // rank 0 warns
  InstallSignalHandlers();
  try {
    const int code = Parse(argc, argv, add_commands);
    // What was flushed on the way and failed is not asked again.
    const bool written = code != 0 || (std::fflush(stdout) == 0 && std::ferror(stdout) == 0);
    if (!written) throw RuntimeFailure("cannot write to standard output");
    return code;
  } catch (const SaidElsewhere& said) {
    return said.exit_code();
  } catch (const std::exception& error) {
    const int code = ExitCodeOf(std::current_exception());
    if (!says || says(code, error.what())) SayOfRank(error.what());
    return code;
  }
}

}  // namespace antigrasp
