#include "antigrasp/app/network_commands.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>
#include <string_view>

#include "antigrasp/core/error.h"
#include "antigrasp/core/kernels.h"
#include "antigrasp/core/launch.h"

namespace antigrasp {
namespace {

char** g_arguments = nullptr;
constexpr int kKeepTheUsersOwn = 0;
constexpr std::array kShared = {"compare", "dataset", "evaluate", "perturb", "train", "trial"};

// Several processes speak to each other by LibTorch.
bool SharesWork(int argc, char** argv) {
  if (argc < 2 || !IsShared(argv[1])) return false;
  const bool asked = std::any_of(argv, argv + argc, [](const char* word) {
    return std::string_view(word).starts_with("--processes");
  });
  return asked || LaunchOfEnvironment().has_value();
}

// The networks that were installed with this program, wherever the prefix was moved to since
// (checkpoints/pretrained.h).
void TellOfInstalledNetworks(const std::filesystem::path& program) {
  const auto folder = program.parent_path().parent_path() / ANTIGRASP_PRETRAINED_DIR;
  if (std::filesystem::is_directory(folder)) {
    setenv("ANTIGRASP_PRETRAINED", folder.c_str(), kKeepTheUsersOwn);
  }
}

}  // namespace

bool IsShared(const std::string& command) {
  return std::count(kShared.begin(), kShared.end(), command) > 0;
}

bool NeedsNetworks(int argc, char** argv) {
  if (SharesWork(argc, argv)) return true;
  const bool help = argc > 2 && std::strcmp(argv[1], "help") == 0;
  const char* command = argc > 1 ? argv[help ? 2 : 1] : "";
  for (const auto& [name, description] : {kTrain, kSample, kReport, kFigure, kGenerator}) {
    if (std::strcmp(command, name) == 0) return true;
  }
  return false;
}

void RememberArguments(char** argv) { g_arguments = argv; }

std::filesystem::path PreparedNetworks() {
  const auto program =
      std::filesystem::read_symlink("/proc/self/exe").parent_path() / "antigrasp-networks";
  PrepareForNetworks();
  // c10d logs every try to reach a rank that has not begun yet; we say who waits for whom.
  if (std::getenv("WORLD_SIZE")) setenv("GLOG_minloglevel", "3", kKeepTheUsersOwn);
  TellOfInstalledNetworks(program);
  return program;
}

void BecomeNetworks() {
  const std::filesystem::path program = PreparedNetworks();
  execv(program.c_str(), g_arguments);
  throw RuntimeFailure(program.string() + " cannot be started (" + std::strerror(errno) +
                       "): this command needs the build with LibTorch");
}

}  // namespace antigrasp
