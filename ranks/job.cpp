#include "antigrasp/ranks/job.h"

#include <signal.h>

#include <fstream>
#include <iterator>
#include <optional>
#include <utility>

#include "antigrasp/core/exit_code.h"
#include "antigrasp/core/launch.h"
#include "antigrasp/core/parallel.h"

namespace antigrasp {
namespace {

bool g_joins = false;  // this process has begun to meet the others

}  // namespace

std::vector<std::string> OwnArguments() {
  std::ifstream file("/proc/self/cmdline", std::ios::binary);
  std::vector<std::string> words;
  for (std::string word; std::getline(file, word, '\0');) words.push_back(word);
  return words;
}

Ranks::Ranks(std::unique_ptr<SpawnedRanks> spawned, std::unique_ptr<RankGroup> group)
    : spawned_(std::move(spawned)), group_(std::move(group)) {}

std::unique_ptr<Ranks> JoinRanks(int processes,
                                 const std::function<std::vector<std::string>()>& same,
                                 const std::function<void()>& pause) {
  std::optional<Launch> launch = LaunchOfEnvironment();
  if (!launch && processes <= 1) return nullptr;
  if (!CanJoin()) {
    throw RuntimeFailure("several processes, but this build was made without libgloo-dev");
  }
  const int most = 4 * HardwareThreads();
  if (!launch && processes > most) {
    throw InputError("--processes " + std::to_string(processes), "command line",
                     "at most " + std::to_string(most) + " on this machine, four a processor");
  }
  JoinOptions options;
  options.same = same();
  g_joins = true;
  options.say = &SayOfRank;
  options.pause = pause;
  std::unique_ptr<SpawnedRanks> spawned;
  if (!launch) {
    spawned = std::make_unique<SpawnedRanks>(processes);
    launch = LaunchOfEnvironment();
    options.listening = [&](std::uint16_t port) {
      std::vector<std::string> words = OwnArguments();
      std::vector<char*> arguments;
      for (std::string& word : words) arguments.push_back(word.data());
      arguments.push_back(nullptr);
      spawned->Start(port, arguments.data());
    };
    options.pause = [&] {
      if (pause) pause();
      spawned->Check();
    };
  }
  if (!launch->leads()) signal(SIGINT, SIG_IGN);
  std::unique_ptr<RankGroup> group = RankGroup::Join(*launch, options);
  return std::make_unique<Ranks>(std::move(spawned), std::move(group));
}

bool SaysFailure(int exit_code, const std::string& line) {
  if (g_joins || exit_code == kExitInterrupted || !CanJoin()) return true;
  try {
    const std::optional<Launch> launch = LaunchOfEnvironment();
    if (!launch || launch->size == 1) return true;
    JoinOptions options;
    options.failure = {exit_code, line};
    RankGroup::Join(*launch, options);
    return true;  // which does not happen: that one fails is seen by all
  } catch (const SaidElsewhere&) {
    return false;
  } catch (const std::exception&) {  // the others do not come
    return true;
  }
}

}  // namespace antigrasp
