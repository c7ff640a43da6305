// antigrasp-networks: the commands that need LibTorch, and those that several processes share.
// `antigrasp` starts it; nobody else has to.
#include <malloc.h>

#include <cstdlib>

#include "antigrasp/app/commands.h"
#include "antigrasp/app/console.h"
#include "antigrasp/app/network_commands.h"
#include "antigrasp/app/program.h"
#include "antigrasp/doctor/examine_networks.h"
#include "antigrasp/ranks/job.h"
#include "antigrasp/ranks/run_shared.h"

namespace antigrasp {
namespace {

void AddCommands(CLI::App* app) {
  const JobRunner job = [](int processes, const SharedRun& run) {
    RunShared(processes, &ThrowIfInterrupted, run);
  };
  AddCompareCommand(app, job);
  AddDatasetCommand(app, job);
  AddEvaluateCommand(app, job);
  AddPerturbCommand(app, job);
  AddTrialCommand(app, job);
  AddTrainCommand(app);
  AddSampleCommand(app);
#ifdef ANTIGRASP_HAS_REPORT
  AddReportCommand(app);
#endif
  AddFigureCommand(app);
  AddGeneratorCommand(app);
  AddNetworkInfoCommand(app);
  app->add_subcommand("doctor", "What antigrasp doctor says of the networks")->callback([] {
    if (!ExamineNetworks(&PrintNow)) std::exit(kOtherBytes);
  });
}

}  // namespace
}  // namespace antigrasp

int main(int argc, char** argv) {
#ifdef __GLIBC__
  // A training step frees and takes the same large blocks again and again: keep them
  // (docs/performance.md).
  mallopt(M_MMAP_THRESHOLD, 1 << 30);
  mallopt(M_TRIM_THRESHOLD, 1 << 30);
#endif
  using namespace antigrasp;
  return RunProgram(argc, argv, AddCommands, [&](int exit_code, const std::string& line) {
    return argc < 2 || !IsShared(argv[1]) || SaysFailure(exit_code, line);
  });
}
