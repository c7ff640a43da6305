#include "antigrasp/datasets/import_request.h"

#include <filesystem>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/error.h"
#include "antigrasp/datasets/import_grids.h"
#include "antigrasp/datasets/import_report.h"
#include "antigrasp/datasets/objects.h"

namespace antigrasp {
namespace {

void RequireNoMeaning(const ImportRequest& request) {
  const bool sign = request.meaning.sign != GridSign::kOfFile;
  if (!sign && request.meaning.spacing == 0.0) return;
  throw InputError(sign ? "--sign" : "--spacing", request.inputs[0], "grids: meshes have none");
}

// Grids are taken as they are.
void RequireNoScaling(const ImportRequest& request, const std::filesystem::path& file) {
  const ImportOptions unasked;
  const char* asked = nullptr;
  if (request.options.resolution != unasked.resolution) asked = "--resolution";
  if (request.options.scale != unasked.scale) asked = "--scale";
  if (request.options.units != unasked.units) asked = "--units";
  if (asked != nullptr) throw InputError(asked, file.string(), "meshes: grids keep their own");
}

}  // namespace

std::string RunImport(const ImportRequest& request, const ProgressFn& progress) {
  const bool helps = Helps(request.options.share);
  RequireApart({request.out, request.report});
  for (const std::string& out : {request.out, request.report}) {
    if (!out.empty() && !helps)
      const AtomicFile probe(out);  // refuses an unwritable target before the work
  }
  const std::vector<std::filesystem::path> inputs(request.inputs.begin(), request.inputs.end());
  const std::vector<std::filesystem::path> grids = GridFilesOf(inputs);
  std::vector<ImportedMesh> reports;
  std::string layouts;
  int resolution = request.options.resolution;
  if (grids.empty()) {
    RequireNoMeaning(request);
    if (!request.report.empty()) ObjectSource(request.inputs).RequireNotRead({request.report});
    reports = ImportMeshes(inputs, request.out, request.options, progress, &layouts);
  } else if (!helps) {
    RequireNoScaling(request, grids[0]);
    for (const std::filesystem::path& file : grids) RequireNotRead(file, {request.report});
    resolution = ShapeSetReader(grids[0], request.meaning).info().n;
    reports = ImportGrids(grids, request.out, request.meaning, request.options.threads, progress);
  }
  if (helps) return "";
  if (!request.report.empty()) WriteFileAtomic(request.report, ImportCsv(reports));
  return layouts + ImportText(reports, request.out, resolution);
}

}  // namespace antigrasp
