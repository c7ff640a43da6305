#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "antigrasp/core/csv_writer.h"
#include "antigrasp/mesh/triangle_mesh.h"
#include "antigrasp/quality/graspability.h"
#include "antigrasp/trial/trial_summary.h"

// The tables of a set of pairs (docs/formats.md, "Pairs of objects").
namespace antigrasp {

// An object on one side, with what both judges say of it.
struct LabelledObject {
  std::string object, side, split;  // no split: it is not in the set
  std::string status = "ok";        // or why it is not
  std::string mesh;                 // its file in the folder
  TriangleMesh solid;               // metres
  Graspability score;
  PhysicsTrial trial;
  TrialSummary summary;                             // of that trial
  std::vector<Eigen::Vector3d> up;                  // of the stable poses, in the frame of the mesh
  Eigen::Vector3d place = Eigen::Vector3d::Zero();  // m; the trial's grasps lie about it

  bool ok() const { return status == "ok"; }
};

class PairObjects {
 public:
  PairObjects();
  void Add(const LabelledObject& object);
  std::string TakeText() { return csv_.TakeText(); }

 private:
  CsvWriter csv_;
};

// Of one side.
class PairGrasps {
 public:
  PairGrasps();
  void Add(const LabelledObject& object);
  std::string TakeText() { return csv_.TakeText(); }

 private:
  CsvWriter csv_;
};

// What a folder of pairs holds, by its objects.csv, for people. InputError for a damaged table.
std::string PairFolderText(const std::filesystem::path& folder);

}  // namespace antigrasp
