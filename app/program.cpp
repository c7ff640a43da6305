#include "antigrasp/app/program.h"

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <cstdio>
#include <filesystem>

#include "antigrasp/app/console.h"
#include "antigrasp/core/error.h"
#include "antigrasp/core/version.h"

namespace antigrasp {
namespace {

enum ExitCode { kOk = 0, kFailure = 1, kBadInput = 2, kInterrupted = 130 };

int Fail(int code, const char* message) {
  std::fprintf(stderr, "antigrasp: %s\n", message);
  return code;
}

void AddHelpCommand(CLI::App* app, std::string* topic) {
  CLI::App* command = app->add_subcommand("help", "Show this, or the help of a command");
  command->add_option("COMMAND", *topic, "command to explain");
  command->callback([app, topic] {
    const CLI::App* about = app;
    if (!topic->empty()) {
      const auto known = app->get_subcommands([&](CLI::App* c) { return c->get_name() == *topic; });
      about = known.empty() ? nullptr : known.front();
    }
    if (about == nullptr) throw InputError("no command " + *topic, "help", "one of antigrasp help");
    // Not help(): that hands over to the subcommand in use, which is this one.
    const std::string name = topic->empty() ? "antigrasp" : "antigrasp " + *topic;
    std::fputs(app->get_formatter()->make_help(about, name, CLI::AppFormatMode::Normal).c_str(),
               stdout);
  });
}

int Parse(int argc, char** argv, const std::function<void(CLI::App*)>& add_commands) {
  CLI::App app(
      "Designs objects that look ordinary and that a parallel-jaw gripper cannot hold "
      "(Adversarial Grasp Objects, Wang et al. 2019)",
      "antigrasp");
  app.set_version_flag("--version", "antigrasp " + ProgramVersion() + " (" + ProgramCommit() + ")");
  app.require_subcommand(1);
  std::string topic;
  add_commands(&app);
  AddHelpCommand(&app, &topic);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& success) {
    return app.exit(success);  // --help, --version
  } catch (const CLI::ParseError& error) {
    return Fail(kBadInput, (std::string(error.what()) + "; see antigrasp help").c_str());
  }
  return kOk;
}

}  // namespace

int RunProgram(int argc, char** argv, const std::function<void(CLI::App*)>& add_commands) {
  spdlog::set_default_logger(spdlog::stderr_color_mt("antigrasp"));
  spdlog::set_pattern("[%H:%M:%S] %^%v%$");
  InstallSignalHandlers();
  try {
    return Parse(argc, argv, add_commands);
  } catch (const InputError& error) {
    return Fail(kBadInput, error.what());
  } catch (const Interrupted&) {
    return Fail(kInterrupted, "interrupted");
  } catch (const std::exception& error) {
    return Fail(kFailure, error.what());
  }
}

}  // namespace antigrasp
