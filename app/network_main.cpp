// antigrasp-networks: the commands that need LibTorch. `antigrasp` starts it; nobody else has to.
#include <malloc.h>

#include "antigrasp/app/commands.h"
#include "antigrasp/app/program.h"

namespace antigrasp {
namespace {

void AddCommands(CLI::App* app) {
  AddTrainCommand(app);
  AddSampleCommand(app);
#ifdef ANTIGRASP_HAS_REPORT
  AddReportCommand(app);
#endif
  AddFigureCommand(app);
  AddGeneratorCommand(app);
  AddNetworkInfoCommand(app);
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
  return antigrasp::RunProgram(argc, argv, antigrasp::AddCommands);
}
