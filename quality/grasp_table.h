#pragma once

#include <string>

#include "antigrasp/core/csv_writer.h"
#include "antigrasp/quality/graspability.h"

namespace antigrasp {

// Every sampled grasp of scored objects, as grasps.csv holds them (docs/formats.md).
class GraspTable {
 public:
  GraspTable();
  // `center_of_mass` in the unit of the mesh.
  void Add(const std::string& object, const Graspability& score,
           const Eigen::Vector3d& center_of_mass);
  // What was added since the last call, the header first.
  std::string TakeText() { return csv_.TakeText(); }

 private:
  CsvWriter csv_;
};

// What became of the candidate grasps of several objects.
class CandidateCount {
 public:
  void Add(const Graspability& score);
  // "12345 candidate grasps: 48 % kept, 20 % slip, ..., 3 copies", by the grasp model's reasons.
  std::string Text() const;

 private:
  double attempts_ = 0.0, kept_ = 0.0;
  RejectedGrasps rejected_;
};

}  // namespace antigrasp
