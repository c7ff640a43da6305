#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "antigrasp/mesh/ray_scene.h"
#include "antigrasp/mesh/stable_poses.h"
#include "antigrasp/quality/execution_noise.h"
#include "antigrasp/quality/graspability.h"
#include "antigrasp/quality/table_reach.h"

// Which grasps a trial executes on an object that stands on a table in front of the gripper.
namespace antigrasp {

// A grasp with the way in that the gripper takes to it and the noise of its executions.
struct TrialGrasp {
  Grasp grasp;                                  // grasp.approach is the way in
  std::size_t pose = 0;                         // the stable pose in which the object stands
  double quality = 0.0;                         // robust quality
  std::vector<NoiseDraw> draws;                 // one an execution
  std::size_t place = 0;                        // among the grasps that were proposed
  std::optional<std::uint64_t> candidate = {};  // its number, which its draws have; none in series
};

// A grasp that was planned elsewhere, in the table's metres and place. Approach: from the palm to
// the fingertips, orthogonal to the axis; zero: any.
struct ProposedGrasp {
  Grasp grasp;
  std::uint64_t number = 0;  // of its draws, as that of a candidate
};

// What was found, of how many.
struct TrialPlan {
  std::vector<TrialGrasp> grasps;
  int wanted = 0;
  int candidates = 0;  // tried
};

// An object on a table: rescaled to metres, about a round place near it (mesh/place.h).
class TrialTable {
 public:
  // `mesh` in its own unit. A mesh that cannot be evaluated is a broken invariant: MakeTrialTable.
  TrialTable(const TriangleMesh& mesh, double scale, const MetricOptions& metric,
             const TableOptions& table);

  const TriangleMesh& mesh() const { return mesh_; }
  const RayScene& scene() const { return scene_; }
  const Eigen::Vector3d& com() const { return com_; }
  const std::vector<StablePose>& poses() const { return poses_; }
  double scale() const { return scale_; }                  // metres per unit of the mesh
  const Eigen::Vector3d& place() const { return place_; }  // taken off the mesh before, its unit

  // The paper's choice (VII-B): a plan of metric.num_grasps grasps; then `count` times a stable
  // pose drawn by its probability and the grasp of highest robust quality that is reachable in it
  // and was not taken yet. `wanted` = count.
  TrialPlan BestUnused(std::uint64_t seed, std::uint64_t object, std::uint64_t series, int count,
                       int executions) const;

  // All grasps that a planner offers: candidates of the metric, each with a stable pose drawn by
  // its probability, kept when the gripper reaches it there, until there are metric.num_grasps.
  // The draws are the first ones of its robust quality's, so that prediction and outcome pair.
  TrialPlan All(std::uint64_t seed, std::uint64_t object, int executions) const;

  // The same in the air: reached as the metric says, in no pose.
  TrialPlan AllInTheAir(std::uint64_t seed, std::uint64_t object, int executions) const;

  // Grasps that were planned elsewhere: each in the most probable stable pose in which the gripper
  // gets to it by its own approach; those that it gets to in none are not among them. In the air
  // all are.
  TrialPlan Proposed(const std::vector<ProposedGrasp>& grasps, std::uint64_t seed,
                     std::uint64_t object, int executions, bool in_the_air) const;

 private:
  std::size_t DrawPose(RngStream* rng) const;
  std::optional<std::size_t> PoseFor(Grasp* grasp) const;
  // With its robust quality and its draws, which are the first ones of that.
  TrialGrasp Planned(const GraspModel& model, const Grasp& grasp, std::size_t pose, RngStream noise,
                     int executions) const;
  TrialPlan Sample(std::uint64_t seed, std::uint64_t object, int executions, bool in_the_air) const;

  Eigen::Vector3d place_;
  TriangleMesh mesh_;
  RayScene scene_;
  Eigen::Vector3d com_;
  std::vector<StablePose> poses_;
  TableReach reach_;
  MetricOptions metric_;
  double scale_;
};

// nullptr for an object that cannot be tried: no size, or (unless `in_the_air`) no stable pose.
std::unique_ptr<const TrialTable> MakeTrialTable(const TriangleMesh& mesh,
                                                 const MetricOptions& metric,
                                                 const TableOptions& table,
                                                 bool in_the_air = false);

}  // namespace antigrasp
