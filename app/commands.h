#pragma once

#include <CLI/App.hpp>

#include "antigrasp/core/work_share.h"

namespace antigrasp {

// One function per command of `antigrasp` or `antigrasp-networks`: adds the subcommand with its
// flags to `app`; its callback does the work and throws on failure (main() turns that into a line
// and an exit code). `job` runs those whose work several processes can share.
void AddDatasetCommand(CLI::App* app, const JobRunner& job);
void AddTrainCommand(CLI::App* app);
void AddSampleCommand(CLI::App* app);
void AddRemeshCommand(CLI::App* app);
void AddEvaluateCommand(CLI::App* app, const JobRunner& job);
void AddCompareCommand(CLI::App* app, const JobRunner& job);
void AddQualityCommand(CLI::App* app);
void AddPerturbCommand(CLI::App* app, const JobRunner& job);
void AddShapeCommand(CLI::App* app);
void AddPosesCommand(CLI::App* app);
void AddTrialCommand(CLI::App* app, const JobRunner& job);
void AddGripperCommand(CLI::App* app);
void AddSheetCommand(CLI::App* app);
void AddReportCommand(CLI::App* app);  // not in a build without the report's page
void AddFigureCommand(CLI::App* app);
void AddExportCommand(CLI::App* app);
void AddBundleCommand(CLI::App* app);
void AddGeneratorCommand(CLI::App* app);
void AddDoctorCommand(CLI::App* app);
void AddInfoCommand(CLI::App* app);         // of meshes and SDF files; else the next
void AddNetworkInfoCommand(CLI::App* app);  // of checkpoints and runs

}  // namespace antigrasp
