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
std::vector<PerturbRow> RowsOf(const std::vector<PerturbedObject>& objects);
// |F_a| on the way: object, iteration, pairs, pairs below the cone (IV-A).
PerturbHistory HistoryOf(const PerturbedObject& item);
// What changed on average, and the failed objects by reason; two or three lines.
std::string PerturbSummary(const std::vector<PerturbedObject>& objects);

// All that may lie in the folder of results.
ResultFiles PerturbFiles();

// InputError when results would come to lie among the files that objects are read from: when these
// are in out/before or out/after.
void CheckPerturbFolder(const std::vector<std::string>& inputs, const std::filesystem::path& out);

// What the graspabilities of perturb.csv were scored on, a line beside the summary: `evaluate` may
// take more grasps of the same object, and an object that was subdivided is another mesh.
std::string ScoredOnText(const std::vector<PerturbedObject>& objects, const MetricOptions& metric);

// What is written beside the meshes.
struct PerturbRecord {
  std::string constants;  // perturb.toml
  bool history = false;   // whether there is a history.csv
  int threads = 0;        // of the picture, which does not depend on it
};

// All results but the table, into a folder without any: PerturbFiles says which. after/ has every
// printable result, before/ every usable input that was not cut short: NAME.stl, or NAME.ply where
// single precision would take more than 1e-5 of the object's size, as it does some hundred times
// its size from the origin. Returns a line for each of these. sheet.png has the first printable
// results, and above each what it was; none without one.
std::vector<std::string> WritePerturbFiles(const std::vector<PerturbedObject>& objects,
                                           const PerturbRecord& record,
                                           const std::filesystem::path& out);

}  // namespace antigrasp
