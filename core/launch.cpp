#include "antigrasp/core/launch.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "antigrasp/core/error.h"

namespace antigrasp {
namespace {

constexpr int kMostRanks = 1 << 20;
constexpr int kDay = 86400;
// Slurm names no port: one of its own for every job (Debian and Slurm use none of these).
constexpr int kFirstPort = 29400, kPorts = 1024;

class Variables {
 public:
  explicit Variables(const ReadVariable& read) : read_(read) {}

  std::string Text(const char* name) const {
    const char* text = read_(name);
    return text == nullptr ? "" : text;
  }
  bool Has(const char* name) const { return !Text(name).empty(); }

  int Number(const char* name, int least, int most) const {
    const std::string text = Text(name);
    int value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || value < least || value > most) {
      throw InputError(std::string(name) + " = \"" + text + "\"", "environment",
                       "a number from " + std::to_string(least) + " to " + std::to_string(most));
    }
    return value;
  }
  int NumberOr(const char* name, int least, int most, int otherwise) const {
    return Has(name) ? Number(name, least, most) : otherwise;
  }

 private:
  const ReadVariable& read_;
};

// The names of one launcher.
struct Names {
  const char *rank, *size, *local;
};

Launch Counted(const Variables& of, const Names& names) {
  Launch launch;
  launch.size = of.Number(names.size, 1, kMostRanks);
  launch.rank = of.Number(names.rank, 0, launch.size - 1);
  launch.local = of.NumberOr(names.local, 1, kMostRanks, 1);
  launch.lost_after =
      of.NumberOr("ANTIGRASP_LOST_AFTER", 1, kDay, static_cast<int>(launch.lost_after));
  return launch;
}

void TakeAddress(const Variables& of, Launch* launch) {
  if (of.Has("MASTER_ADDR")) launch->host = of.Text("MASTER_ADDR");
  const bool has_port = of.Has("MASTER_PORT") || launch->port != 0;
  launch->port =
      static_cast<std::uint16_t>(of.NumberOr("MASTER_PORT", 0, 65535, int{launch->port}));
  if (!launch->host.empty() && has_port) return;
  throw InputError(
      std::string(launch->host.empty() ? "MASTER_ADDR" : "MASTER_PORT") + " is not set",
      "environment", "the address and a free port of the machine of rank 0");
}

}  // namespace

std::string FirstHost(const std::string& list) {
  const std::size_t bracket = list.find('['), comma = list.find(',');
  if (bracket == std::string::npos || comma < bracket) return list.substr(0, comma);
  const std::size_t end = list.find_first_of("-,]", bracket);
  if (end == std::string::npos) return list.substr(0, bracket);
  return list.substr(0, bracket) + list.substr(bracket + 1, end - bracket - 1);
}

std::optional<Launch> LaunchOfEnvironment(const ReadVariable& read) {
  const Variables of(read);
  if (of.Has("RANK") && of.Has("WORLD_SIZE")) {
    Launch launch = Counted(of, {"RANK", "WORLD_SIZE", "LOCAL_WORLD_SIZE"});
    TakeAddress(of, &launch);
    launch.store_is_there = of.Text("TORCHELASTIC_USE_AGENT_STORE") == "True";
    if (launch.store_is_there) {
      launch.prefix = "/worker/attempt_" + of.Text("TORCHELASTIC_RESTART_COUNT");
    }
    return launch;
  }
  if (of.Has("OMPI_COMM_WORLD_RANK")) {
    Launch launch =
        Counted(of, {"OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE", "OMPI_COMM_WORLD_LOCAL_SIZE"});
    if (launch.size == 1) return std::nullopt;
    if (launch.local == launch.size) launch.host = "127.0.0.1";
    TakeAddress(of, &launch);
    return launch;
  }
  if (of.Has("SLURM_PROCID") && of.Has("SLURM_NTASKS") && of.Has("SLURM_STEP_ID")) {
    Launch launch = Counted(of, {"SLURM_PROCID", "SLURM_NTASKS", "SLURM_NTASKS_PER_NODE"});
    if (launch.size == 1) return std::nullopt;
    launch.host = FirstHost(of.Text("SLURM_JOB_NODELIST"));
    launch.port = static_cast<std::uint16_t>(
        kFirstPort + of.NumberOr("SLURM_JOB_ID", 0, 2147483647, 0) % kPorts);
    TakeAddress(of, &launch);
    return launch;
  }
  return std::nullopt;
}

std::optional<Launch> LaunchOfEnvironment() {
  return LaunchOfEnvironment([](const char* name) -> const char* { return std::getenv(name); });
}

bool LeadsJob() {
  try {
    const std::optional<Launch> launch = LaunchOfEnvironment();
    return !launch || launch->leads();
  } catch (const InputError&) {
    return true;  // said where the job begins
  }
}

int ProcessesHere() {
  try {
    const std::optional<Launch> launch = LaunchOfEnvironment();
    return launch ? launch->local : 1;
  } catch (const InputError&) {
    return 1;  // said where the job begins
  }
}

std::vector<std::string> EnvironmentAlone() {
  constexpr std::array kOfRanks = {
      "RANK=", "WORLD_SIZE=", "OMPI_COMM_WORLD_RANK=", "SLURM_PROCID="};
  std::vector<std::string> variables;
  for (char** variable = environ; *variable != nullptr; ++variable) {
    const std::string_view text = *variable;
    const bool of_ranks = std::any_of(kOfRanks.begin(), kOfRanks.end(),
                                      [&](const char* name) { return text.starts_with(name); });
    if (!of_ranks) variables.emplace_back(text);
  }
  return variables;
}

std::string HostName() {
  std::array<char, 256> host{};
  gethostname(host.data(), host.size() - 1);
  return host.data();
}

std::string Speaker() {
  const std::string program = "antigrasp";
  try {
    const std::optional<Launch> launch = LaunchOfEnvironment();
    if (!launch || launch->size == 1) return program;
    return program + " (rank " + std::to_string(launch->rank) + " on " + HostName() + ")";
  } catch (const InputError&) {
    return program;  // whose own message says what is wrong
  }
}

void SayOfRank(const std::string& line) {
  std::fprintf(stderr, "%s: %s\n", Speaker().c_str(), line.c_str());
  std::fflush(stderr);
}

}  // namespace antigrasp
