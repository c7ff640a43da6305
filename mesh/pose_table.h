#pragma once

#include <string>
#include <vector>

#include "antigrasp/core/csv_writer.h"
#include "antigrasp/mesh/length_unit.h"
#include "antigrasp/mesh/stable_poses.h"

namespace antigrasp {

// StablePoses about the centre of mass; of an object that is no solid, and may enclose no volume,
// about that of its hull.
std::vector<StablePose> StablePosesOf(const TriangleMesh& mesh, bool is_solid);

// The poses of objects as poses.csv holds them (docs/formats.md), heights in metres.
class PoseTable {
 public:
  explicit PoseTable(LengthUnit units);  // of the meshes
  void Add(const std::string& object, const std::vector<StablePose>& poses);
  const std::string& Csv() const { return csv_.text(); }

 private:
  LengthUnit units_;
  CsvWriter csv_;
};

}  // namespace antigrasp
