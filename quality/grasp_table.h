#pragma once

#include <array>
#include <string>

#include "antigrasp/core/choice.h"
#include "antigrasp/core/csv_writer.h"
#include "antigrasp/quality/graspability.h"

namespace antigrasp {

// The lengths and places of a table of grasps. Nothing is ever moved: a point of the user's file is
// one of the metric's divided by Graspability::scale.
enum class GraspFrame {
  kMetres,  // as the metric looks at the object: rescaled
  kMesh     // the unit and frame of the mesh that was read
};
constexpr auto ChoicesOf(GraspFrame) {
  return std::to_array<Choice<GraspFrame>>(
      {{GraspFrame::kMetres, "metres"}, {GraspFrame::kMesh, "mesh"}});
}

// Every sampled grasp of scored objects, as grasps.csv holds them (docs/formats.md).
class GraspTable {
 public:
  explicit GraspTable(GraspFrame frame = GraspFrame::kMetres);
  // `center_of_mass` in the unit of the mesh.
  void Add(const std::string& object, const Graspability& score,
           const Eigen::Vector3d& center_of_mass);
  // What was added since the last call, the header first.
  std::string TakeText() { return csv_.TakeText(); }

 private:
  GraspFrame frame_;
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
