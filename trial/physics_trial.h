#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "antigrasp/core/parallel.h"
#include "antigrasp/quality/metric_options.h"
#include "antigrasp/trial/execution.h"
#include "antigrasp/trial/model_trial.h"
#include "antigrasp/trial/trial_table.h"

// Objects tried in a physics engine: planned grasps, executed under the metric's noise.
namespace antigrasp {

struct PhysicsTrialOptions {
  ProtocolName protocol = ProtocolName::kSixWays;
  PhysicsOptions physics;
  int draws = 5;            // executions of each grasp of a protocol that tries all of them
  double density = 1000.0;  // kg/m3
  double mass = 0.0;        // kg, of every object; 0 = density times volume
  TrialOptions series;      // of a protocol that tries the best: series, grasps, executions, table
};
void Bind(OptionTable* table, PhysicsTrialOptions* options);  // keys "trial.*", those of series too

// What the protocol lays down goes before what the metric's and the fingertip's defaults are:
// friction and the patch of a fingertip, where the source says one. Call before flags are applied.
void ApplyProtocol(const Protocol& protocol, MetricOptions* metric, PhysicsTrialOptions* options);

struct ExecutedDraw {
  double friction = 0.0;
  double predicted = 0.0;  // the metric's epsilon under this very draw, 0 = it slips
  Execution execution;
};

struct ExecutedGrasp {
  TrialGrasp planned;
  std::uint64_t series = 0;  // 0 where all grasps are tried
  std::vector<ExecutedDraw> draws;
};

struct PhysicsTrial {
  bool tried = false;  // else no size, no stable pose
  double mass = 0.0;   // kg
  double metres_per_unit = 1.0;
  int poses = 0;
  int wanted = 0;                     // grasps asked for
  int candidates = 0;                 // candidate grasps tried for them
  std::vector<ExecutedGrasp> grasps;  // by series, then in the order of the plan
};

// Tries one object after another; engines and their models are kept between objects.
class PhysicsTrials {
 public:
  // InputError for a force above close_speed * finger_mass / time_step: the jaws' speed would grow
  // from step to step.
  PhysicsTrials(const MetricOptions& metric, const PhysicsTrialOptions& options, std::uint64_t seed,
                int threads = 0, Pace pace = Pace::kEarly);
  ~PhysicsTrials();

  // The object's draws come from the streams of this number. Grasps are executed in parallel; same
  // values for any number of threads. `mesh`: closed and outward, in its own unit. A hundred grasps
  // five times: about a second on one core.
  PhysicsTrial Try(const TriangleMesh& mesh, std::uint64_t stream);
  // The same with grasps that were planned elsewhere (TrialTable::Proposed) in place of the
  // protocol's own, each `draws` times, or options.series.executions where the protocol has series.
  // Which of them a grasp of the trial is: its planned.place.
  PhysicsTrial Try(const TriangleMesh& mesh, std::uint64_t stream,
                   const std::vector<ProposedGrasp>& grasps);
  // An execution of the object that was tried last, once more and step by step. The body's frame
  // lies in the mesh's as MeshPose says.
  Execution Replay(const ExecutedGrasp& grasp, std::size_t draw, const ReplayFn& replay);
  // The pose of the last object's own frame (its unit times metres_per_unit) when its body has this
  // pose.
  Eigen::Isometry3d MeshPose(const Eigen::Isometry3d& body) const;
  GripStart StartOfDraw(const ExecutedGrasp& grasp, std::size_t draw) const;  // of the last object

  const Protocol& protocol() const { return protocol_; }
  const TrialTable& table() const { return *table_; }  // of the last object that could be tried

 private:
  struct Pool;
  bool Place(const TriangleMesh& mesh,
             PhysicsTrial* trial);  // on its table; false: cannot be tried
  void ExecuteAll(PhysicsTrial* trial);

  MetricOptions metric_;
  PhysicsTrialOptions options_;
  Protocol protocol_;
  std::uint64_t seed_;
  int threads_;
  Pace pace_;
  std::unique_ptr<Pool> engines_;
  std::unique_ptr<const TrialTable> table_;  // of the last object, and its body
  std::unique_ptr<const GrippedBody> body_;
};

// Where an execution begins: the gripper's frame at the executed pose of the grasp.
GripStart StartOf(const TrialTable& table, const GrippedBody& body, const TrialGrasp& planned,
                  const NoiseDraw& noise, double jaw_opening, bool on_table);

}  // namespace antigrasp
