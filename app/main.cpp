// antigrasp: the commands on meshes. Those that need networks are only named here
// (network_commands.h).
#include "antigrasp/app/commands.h"
#include "antigrasp/app/network_commands.h"
#include "antigrasp/app/program.h"

namespace antigrasp {
namespace {

void Name(const NetworkCommand& command, CLI::App* app) {
  app->add_subcommand(command.name, command.description);
}

void AddCommands(CLI::App* app) {
  const JobRunner alone = [](int, const SharedRun& run) { run(nullptr); };
  AddDatasetCommand(app, alone);
  Name(kTrain, app);
  Name(kSample, app);
  AddRemeshCommand(app);
  AddEvaluateCommand(app, alone);
  AddCompareCommand(app, alone);
  AddQualityCommand(app);
  AddPerturbCommand(app, alone);
  AddShapeCommand(app);
  AddPosesCommand(app);
  AddTrialCommand(app, alone);
  AddGripperCommand(app);
  AddSheetCommand(app);
#ifdef ANTIGRASP_HAS_REPORT
  Name(kReport, app);
#endif
  Name(kFigure, app);
  AddExportCommand(app);
  AddBundleCommand(app);
  Name(kGenerator, app);
  AddInfoCommand(app);
  AddDoctorCommand(app);
}

}  // namespace
}  // namespace antigrasp

int main(int argc, char** argv) {
  using namespace antigrasp;
  RememberArguments(argv);
  return RunProgram(argc, argv, [&](CLI::App* app) {
    if (NeedsNetworks(argc, argv)) BecomeNetworks();
    AddCommands(app);
  });
}
