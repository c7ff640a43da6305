#include "antigrasp/perturb/perturb_objects.h"

#include <optional>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/error.h"
#include "antigrasp/datasets/result_folder.h"
#include "antigrasp/judge/object_notes.h"
#include "antigrasp/perturb/perturb_all.h"
#include "antigrasp/perturb/perturb_folder.h"
#include "antigrasp/perturb/perturb_summary.h"
#include "antigrasp/quality/object_size.h"

namespace antigrasp {

void PerturbObjects(const PerturbRequest& request, const PerturbSettings& settings,
                    RunObserver* observer, const std::function<void(const std::string&)>& warn,
                    const std::function<void(const std::string&)>& say) {
  const std::filesystem::path out = request.out;
  CheckPerturbFolder(request.inputs, out);
  const ObjectSource source(request.inputs, GridUnit::kOfFiles, UnitToReadIn(settings.metric));
  for (const std::string& file : PerturbFiles().of_call) {
    RequireNotRead(request.gripper, {out / file});
  }
  std::optional<ResultFolder> results;
  if (!Helps(request.share)) results.emplace(out, PerturbFiles(), source, request.overwrite);
  auto inputs = LoadObjects(source, request.threads, observer->Phase("reading"));
  WarnOfNotes(inputs, warn);
  WarnOfSizes(inputs, settings.metric, warn);
  const auto stop = [&] { return observer->StopRequested(); };
  const auto objects = PerturbAll(std::move(inputs), settings, request.threads, stop,
                                  observer->Phase("perturbing"), request.share);
  if (!results) return;
  const std::vector<std::string> notes = WritePerturbFiles(
      objects, {request.constants, settings.common.history, request.threads}, results->path());
  for (const std::string& note : notes) warn(note);
  const std::vector<PerturbRow> rows = RowsOf(objects);
  results->Commit(PerturbCsv(rows));
  for (const PerturbedObject& item : objects) {
    if (item.Status() != "ok") warn(item.object.name + ": " + item.Status());
  }
  std::string text = PerturbSummary(objects);
  const bool any = MeansOf(rows).ok > 0;
  if (any) {
    text += ScoredOnText(objects, settings.metric) + "\n" +
            "meshes before and after, their picture (sheet.png) and perturb.csv in " + request.out +
            "\n";
  }
  say(text);
  if (stop()) throw Interrupted();
  if (!any) {
    throw RuntimeFailure("no object was perturbed: " + results->table().string() + " says why");
  }
}

}  // namespace antigrasp
