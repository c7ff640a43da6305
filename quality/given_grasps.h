#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "antigrasp/mesh/triangle_mesh.h"
#include "antigrasp/quality/contact.h"
#include "antigrasp/quality/grasp_table.h"
#include "antigrasp/quality/metric_options.h"

// Grasps that somebody else planned: read from a table, scored on an object.
namespace antigrasp {

// Where a parallel jaw is to close, as a table says it.
struct GivenGrasp {
  std::string object;  // as the table calls it; empty without a column
  std::string id;      // column `grasp`, else the number of the row among the object's, from 0
  GraspFrame frame = GraspFrame::kMesh;
  double metres_per_unit = 1.0;  // of the metres that kMetres is in
  bool says_scale = false;       // whether the table has a number there, in whatever frame
  // NaN where the table has no number. The centre is where the jaws meet, the axis goes from jaw 1
  // to jaw 2, the approach from the palm to the fingertips (zero: none was given).
  Eigen::Vector3d center, axis, approach = Eigen::Vector3d::Zero();
  double width = 0.0;           // between the jaws; 0: none was given
  std::uint64_t candidate = 0;  // the number of its draws: column `candidate`, else as `id`
  bool of_a_candidate = false;  // whether there is such a column
};

// Columns by name, in any order, others ignored. Needed: the axis (axis_x, axis_y, axis_z) and the
// centre (center_x, ...), or in place of either the contacts (p1x ... p2z), in whose middle the
// centre then is. If there are such columns: approach_x ..., width, object, grasp, candidate, and
// frame (mesh or metres, and then metres_per_unit; without it the mesh's unit and frame).
// InputError with file:line for a table without rows, without a needed column, with one or two of
// the three columns of a vector, with text where a number must be, and for one of an earlier
// version that does not say its frame.
std::vector<GivenGrasp> ReadGivenGrasps(const std::filesystem::path& path);

// How a given grasp scores. Local frame: metres, about the object's round place (local_object.h).
struct GivenScore {
  // "ok": as planned both jaws first touch the object from outside, within their friction cones.
  // Else epsilon is 0: "starts inside" (an open jaw is in the object), "misses" (a jaw meets
  // nothing on its way to the centre: the grasp is beside the object), "slips". Not scored: "too
  // wide" (more than the jaws open), "no pose" (a number is missing, infinite or beyond 1,000 km,
  // no direction), "not evaluable" (the object is not).
  std::string status;
  double epsilon = 0.0;         // as planned: no noise, friction as it is meant
  double robust_quality = 0.0;  // as EvaluateGraspability has it, with the draws of `candidate`
  // Whether the gripper gets there: by the approach that was given, or by some; nullopt where no
  // gripper is looked at.
  std::optional<bool> reachable;
  Grasp grasp;  // approach: that, one that was found, or zero; contacts and width only when "ok"

  static constexpr const char *kOk = "ok", *kSlips = "slips", *kStartsInside = "starts inside",
                              *kMisses = "misses";
  bool scored() const {
    return status == kOk || status == kSlips || status == kStartsInside || status == kMisses;
  }
};

// `object`: the number of the random stream that the object's grasps are sampled from. A row that
// names a candidate whose pose it has but for rounding (1e-9 m) is that candidate, to the last bit:
// what EvaluateGraspability sampled scores the same again, in whatever frame it was written.
std::vector<GivenScore> ScoreGivenGrasps(const TriangleMesh& mesh,
                                         const std::vector<GivenGrasp>& grasps,
                                         const MetricOptions& options, std::uint64_t seed,
                                         std::uint64_t object);

}  // namespace antigrasp
