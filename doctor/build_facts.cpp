#include "antigrasp/doctor/build_facts.h"

#include <sys/utsname.h>

#include <algorithm>
#include <fstream>

#include "antigrasp/core/parallel.h"
#include "antigrasp/core/version.h"
#include "antigrasp/doctor/library_versions.h"
#include "antigrasp/quality/epsilon_closed_form.h"
#include "antigrasp/trial/physics_engine.h"

namespace antigrasp {
namespace {

// The value behind the first `key` of a file of lines `key SEPARATOR value`; "" without one.
std::string ValueIn(const char* path, const std::string& key, char separator) {
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with(key)) continue;
    const std::size_t begin = line.find_first_not_of(" \"", line.find(separator) + 1);
    if (begin == std::string::npos) return {};
    return line.substr(begin, line.find_last_not_of('"') + 1 - begin);
  }
  return {};
}

std::string System() {
  utsname kernel{};
  uname(&kernel);
  const std::string name = ValueIn("/etc/os-release", "PRETTY_NAME", '=');
  return (name.empty() ? "" : name + ", ") + kernel.sysname + " " + kernel.release + ", " +
         kernel.machine;
}

// "avx512, of baseline, avx2, avx512; Intel(R) Xeon(R) Processor".
std::string InstructionSet() {
  std::string all;
  for (const SimdLevel level : SupportedSimdLevels()) {
    all += (all.empty() ? "" : ", ") + std::string(Name(level));
  }
  const std::string processor = ValueIn("/proc/cpuinfo", "model name", ':');
  return std::string(Name(SupportedSimdLevels().back())) + ", of " + all +
         (processor.empty() ? "" : "; " + processor);
}

std::string Physics() {
  const std::string version = MujocoVersion();
  return version.empty() ? "not built: MuJoCo was not found (libmujoco-dev)" : "MuJoCo " + version;
}

std::string Version() {
  const std::string commit = ProgramCommit();
  return ProgramVersion() + (commit.empty() ? "" : " (" + commit + ")");
}

}  // namespace

std::string FactLine(const std::string& what, const std::string& found) {
  constexpr std::size_t kColumn = 18;
  return what + std::string(std::max(kColumn, what.size() + 1) - what.size(), ' ') + found + "\n";
}

std::string BuildFacts() {
  return FactLine("antigrasp", Version()) + FactLine("system", System()) +
         FactLine("compiler", ANTIGRASP_COMPILER) +
         FactLine("libraries", LibrariesText(GeometryLibraries())) +
         FactLine("instruction set", InstructionSet()) +
         FactLine("threads", std::to_string(HardwareThreads())) + FactLine("physics", Physics()) +
         FactLine("report", ANTIGRASP_REPORT_STATE) + FactLine("formats", ANTIGRASP_FORMAT_STATE) +
         (BuiltWithNetworks() ? "" : FactLine("networks", "not built: -DANTIGRASP_TORCH=OFF"));
}

bool BuiltWithNetworks() { return ANTIGRASP_BUILT_WITH_NETWORKS; }

}  // namespace antigrasp
