#include "antigrasp/app/commands.h"
#include "antigrasp/app/console.h"
#include "antigrasp/app/network_commands.h"
#include "antigrasp/doctor/examine.h"

namespace antigrasp {

void AddDoctorCommand(CLI::App* app) {
  app->add_subcommand("doctor",
                      "Say what this program is made of and whether it works as it should")
      ->callback([] {
        ConsoleObserver observer;
        Examine(
            &PrintNow, [] { return RunChild(PreparedNetworks(), {"doctor"}); }, &observer);
      });
}

}  // namespace antigrasp
