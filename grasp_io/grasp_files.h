#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/choice.h"
#include "antigrasp/core/staged_folder.h"
#include "antigrasp/datasets/objects.h"
#include "antigrasp/grasp_io/grasp_hdf5.h"
#include "antigrasp/grasp_io/grasp_set.h"
#include "antigrasp/quality/given_grasps.h"
#include "antigrasp/quality/grasp_table.h"
#include "antigrasp/quality/scored_object.h"

namespace antigrasp {

enum class GraspFormat { kAuto, kCsv, kIsaac, kGraspGen, kAcronym, kMultiGripper, kDexNet };
constexpr auto ChoicesOf(GraspFormat) {
  return std::to_array<Choice<GraspFormat>>({{GraspFormat::kAuto, "auto"},
                                             {GraspFormat::kCsv, "csv"},
                                             {GraspFormat::kIsaac, "isaac"},
                                             {GraspFormat::kGraspGen, "graspgen"},
                                             {GraspFormat::kAcronym, "acronym"},
                                             {GraspFormat::kMultiGripper, "multigripper"},
                                             {GraspFormat::kDexNet, "dexnet"}});
}

// Where grasps are to be written, and as what.
struct GraspOutput {
  std::string path;  // empty: nowhere
  // kAuto: .yaml and .yml isaac, .json graspgen, .h5 acronym, .hdf5 dexnet, all others csv.
  GraspFormat format = GraspFormat::kAuto;
  GraspFrame frame = GraspFrame::kMetres;  // of csv
  GraspFileAbout about;
};

// The grasps of scored objects in one file, or, in a format that holds one object a file, in a file
// each. Nothing appears before Commit().
class GraspFiles {
 public:
  // InputError, before any work, for a place that cannot be written to, for several objects in a
  // format of one without a new or empty folder, and for a frame that the format has not.
  GraspFiles(GraspOutput output, const ObjectSource& objects);
  // Object by object, each once. Of what was sampled, and of what was given and scored; the mesh of
  // a set is read here, where the format holds it. A grasp without a way in has no pose of a base
  // and is left out; so is an object without grasps.
  void Add(std::int64_t place, const ScoredObject& scored);
  void Add(std::int64_t place, GraspSet set);
  // InputError for a format that holds no label: call before what has one is made.
  void RequireLabels() const;
  bool wanted() const { return !output_.path.empty(); }
  // InputError when there is no grasp to write, but for csv. What was left out, a line each.
  std::vector<std::string> Commit();

 private:
  bool OfOneObject() const;

  GraspOutput output_;
  const ObjectSource& objects_;
  std::optional<AtomicFile> file_;
  std::optional<StagedFolder> folder_;
  GraspTable table_;
  std::optional<DexNetFile> dexnet_;
  std::int64_t written_ = 0, without_way_ = 0, empty_ = 0;
};

// Grasps that somebody else planned, from a file of any of these formats or a folder of them.
struct GraspsRead {
  std::vector<GivenGrasp> grasps;
  // Not from a table: the object is a mesh in somebody's folder, and the grasps are for it at the
  // scale that the file says.
  bool of_mesh_files = false;
};
// InputError as each format's reader, and for a folder without such files. `base`, `metric`: the
// gripper that scores them, whose depth leads from its base to the grasp.
GraspsRead ReadGraspFiles(const std::string& path, const GripperBase& base,
                          const MetricOptions& metric);

}  // namespace antigrasp
