#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "antigrasp/datasets/objects.h"
#include "antigrasp/datasets/result_folder.h"
#include "antigrasp/perturb/perturb_table.h"
#include "antigrasp/perturb/scored_perturbation.h"

namespace antigrasp {

// An object of the command line with what became of it.
struct PerturbedObject {
  InputObject object;
  ScoredPerturbation scored;  // empty when the object is not usable or the work was cut short
  bool interrupted = false;
  // "ok", "interrupted", or why there is no result to print ("before: open: ...", "after:
  // self-intersecting", "unchanged: too few vertices: 8").
  std::string Status() const;
};

PerturbRow RowOf(const PerturbedObject& item);  // of perturb.csv
// |F_a| on the way: object, iteration, pairs, pairs below the cone (IV-A).
PerturbHistory HistoryOf(const PerturbedObject& item);
// What changed on average, and the failed objects by reason; two or three lines.
std::string PerturbSummary(const std::vector<PerturbedObject>& objects);

// All that may lie in the folder of results.
ResultFiles PerturbFiles();

// InputError when the folder of results would be one that objects are read from: the next call
// would take its results for objects.
void CheckPerturbFolder(const std::vector<std::string>& inputs, const std::filesystem::path& out);

// out/after/NAME.stl for every printable result, out/before/NAME.stl for every usable input that
// was not cut short; what an earlier call left there of the others goes. NAME.ply where single
// precision would take more than 1e-5 of the object's size: it lies some hundred times its size
// from the origin. Returns a line for each of these.
std::vector<std::string> WritePerturbedMeshes(const std::vector<PerturbedObject>& objects,
                                              const std::filesystem::path& out);

// out/sheet.png: the first printable results, and above each what it was. Nothing without one.
void WritePerturbedSheet(const std::vector<PerturbedObject>& objects,
                         const std::filesystem::path& out, int threads);

}  // namespace antigrasp
