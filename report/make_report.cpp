#include "antigrasp/report/make_report.h"

#include "antigrasp/core/error.h"
#include "antigrasp/report/objects_report.h"
#include "antigrasp/report/perturbed_report.h"
#include "antigrasp/report/run_report.h"

namespace antigrasp {

Report MakeReport(const ReportSettings& settings, bool metric_given, RunObserver* observer) {
  for (const std::string& input : settings.inputs) {
    const bool run = IsRun(input), perturbed = !run && IsPerturbed(input);
    const bool own_metric = run || perturbed || IsScoreTable(input);
    if (own_metric && metric_given) {
      throw InputError("constants of the metric or a seed for " + input, "command line",
                       "none: it is shown with its own");
    }
    if (!run && !perturbed) continue;
    if (settings.inputs.size() > 1) {
      throw InputError(input + " beside other inputs", "command line",
                       "a run or a folder of perturbed objects alone");
    }
    return run ? RunReport(RunFolder{input}, settings, observer)
               : PerturbedReport(input, settings, observer);
  }
  return ObjectsReport(settings, observer);
}

}  // namespace antigrasp
