#include "antigrasp/trial/physics_trial.h"

#include <algorithm>
#include <limits>
#include <mutex>

#include "antigrasp/core/error.h"
#include "antigrasp/core/format.h"
#include "antigrasp/quality/parallel_jaws.h"

namespace antigrasp {

using Eigen::Isometry3d;
using Eigen::Vector3d;

// Engines that wait for work, one a thread; each knows the object it has loaded.
struct PhysicsTrials::Pool {
  struct Seat {
    std::unique_ptr<PhysicsEngine> engine;
    std::uint64_t loaded = 0;  // number of the object
  };
  PhysicsOptions options;
  std::mutex mutex;
  std::vector<Seat> idle;
  std::uint64_t object = 0;
  double mass = 0.0;  // of the object

  Seat Take(const GrippedBody& body) {
    Seat seat;
    {
      const std::lock_guard lock(mutex);
      if (!idle.empty()) {
        seat = std::move(idle.back());
        idle.pop_back();
      }
    }
    if (seat.engine == nullptr) seat.engine = MakeMujocoEngine(options);
    if (seat.loaded != object) seat.engine->Load(body, mass);
    seat.loaded = object;
    return seat;
  }
  void GiveBack(Seat seat) {
    const std::lock_guard lock(mutex);
    idle.push_back(std::move(seat));
  }
};

void Bind(OptionTable* table, PhysicsOptions* options) {
  PhysicsOptions& o = *options;
  table->Add("trial.tip", &o.tip.shape, "fingertips: a ball, or a flat pad with patch contact");
  table->Add("trial.tip_radius", &o.tip.radius, 1e-4, 0.1, "of a ball, m");
  table->Add("trial.patch_radius", &o.tip.patch_radius, 0.0, 0.1,
             "of a ball's contact, m: torque up to 2/3 of it times friction times force");
  table->Add("trial.pad_width", &o.tip.pad_width, 1e-4, 0.5, "across grasp axis and way in, m");
  table->Add("trial.pad_height", &o.tip.pad_height, 1e-4, 0.5, "along the way in, m");
  table->Add("trial.force", &o.force, 0.01, 1e4, "of each jaw, N");
  table->Add("trial.close_speed", &o.close_speed, 1e-4, 1.0, "of each jaw, m/s");
  table->Add("trial.finger_mass", &o.finger_mass, 0.01, 100.0,
             "of each finger with what moves it, kg");
  table->Add("trial.table_friction", &o.table_friction, 0.0, 10.0, "between object and table");
  table->Add("trial.time_step", &o.time_step, 1e-5, 0.002, "s");
}

void Bind(OptionTable* table, PhysicsTrialOptions* options) {
  PhysicsTrialOptions& o = *options;
  table->Add("trial.draws", &o.draws, 1, 1e4,
             "executions of each grasp, fresh noise, where all grasps are tried");
  table->Add("trial.density", &o.density, 1e-3, 1e5, "kg/m3");
  table->Add("trial.mass", &o.mass, 0.0, 1e3,
             "of every object, kg; 0 = its volume times the density, or the protocol's");
  Bind(table, &o.physics);
  Bind(table, &o.series);
}

void ApplyProtocol(const Protocol& protocol, MetricOptions* metric, PhysicsTrialOptions* options) {
  options->protocol = protocol.name;
  if (protocol.friction > 0.0) metric->friction = protocol.friction;
  if (protocol.torsion > 0.0) {
    options->physics.tip.patch_radius = 1.5 * protocol.torsion / protocol.friction;
  }
  if (protocol.mass > 0.0) options->mass = protocol.mass;
}

GripStart StartOf(const TrialTable& table, const GrippedBody& body, const TrialGrasp& planned,
                  const NoiseDraw& noise, double jaw_opening, bool on_table) {
  const JawPose jaws = ExecutedPose(planned.grasp, table.com(), noise);
  const Isometry3d gripper = GripperFrame(planned.grasp, jaws);  // in the object's frame
  GripStart start;
  start.body = gripper.inverse() * body.from_object.inverse();
  start.opening = jaw_opening;
  start.friction = noise.friction;
  if (!on_table) return start;
  const Vector3d up = table.poses()[planned.pose].table_from_object.row(2);
  double lowest = std::numeric_limits<double>::infinity();
  for (const Vector3d& vertex : table.mesh().vertices) {
    lowest = std::min(lowest, up.dot(vertex - jaws.center));
  }
  start.up = gripper.linear().transpose() * up;
  start.table = lowest;
  return start;
}

namespace {

// A jaw's drive is a force that falls with its speed, taken in step by step: the speed settles only
// when a step takes away no more of it than there is.
void RequireSteadyDrive(const PhysicsOptions& o) {
  const double most = o.close_speed * o.finger_mass / o.time_step;
  if (o.force <= most) return;
  throw InputError("jaws of " + FormatDouble(o.finger_mass) + " kg at " +
                       FormatDouble(o.close_speed) + " m/s do not settle in steps of " +
                       FormatDouble(o.time_step) + " s with " + FormatDouble(o.force) + " N",
                   "--force",
                   "at most " + FormatDouble(most) +
                       " N, or a greater --finger-mass or --close-speed, or a smaller --time-step");
}

}  // namespace

PhysicsTrials::PhysicsTrials(const MetricOptions& metric, const PhysicsTrialOptions& options,
                             std::uint64_t seed, int threads, Pace pace)
    : metric_(metric),
      options_(options),
      protocol_(ProtocolOf(options.protocol)),
      seed_(seed),
      threads_(threads),
      pace_(pace),
      engines_(std::make_unique<Pool>()) {
  RequireSteadyDrive(options.physics);
  engines_->options = options.physics;
  engines_->GiveBack({MakeMujocoEngine(options.physics), 0});  // which refuses a build without it
}

PhysicsTrials::~PhysicsTrials() = default;

namespace {

// Plans of all series, one after another, and the counts that belong to them.
void Plan(const TrialTable& table, const Protocol& protocol, const PhysicsTrialOptions& options,
          std::uint64_t seed, std::uint64_t stream, int threads, PhysicsTrial* trial) {
  const bool best = protocol.choice == GraspChoice::kBestUnused;
  std::vector<TrialPlan> plans(best ? static_cast<std::size_t>(options.series.series) : 1);
  ParallelFor(std::ssize(plans), threads, [&](std::int64_t i) {
    plans[static_cast<std::size_t>(i)] =
        best             ? table.BestUnused(seed, stream, static_cast<std::uint64_t>(i),
                                            options.series.grasps_per_series, options.series.executions)
        : protocol.table ? table.All(seed, stream, options.draws)
                         : table.AllInTheAir(seed, stream, options.draws);
  });
  for (std::size_t i = 0; i < plans.size(); ++i) {
    trial->wanted += plans[i].wanted;
    trial->candidates += plans[i].candidates;
    for (TrialGrasp& grasp : plans[i].grasps) {
      trial->grasps.push_back({std::move(grasp), i, {}});
    }
  }
}

}  // namespace

bool PhysicsTrials::Place(const TriangleMesh& mesh, PhysicsTrial* trial) {
  table_ = MakeTrialTable(mesh, metric_, options_.series.table, !protocol_.table);
  if (table_ == nullptr) return false;
  body_ = std::make_unique<const GrippedBody>(MakeGrippedBody(table_->mesh()));
  trial->tried = true;
  trial->metres_per_unit = table_->scale();
  trial->mass = engines_->mass =
      options_.mass > 0.0 ? options_.mass : options_.density * body_->volume;
  trial->poses = static_cast<int>(table_->poses().size());
  return true;
}

PhysicsTrial PhysicsTrials::Try(const TriangleMesh& mesh, std::uint64_t stream) {
  PhysicsTrial trial;
  if (!Place(mesh, &trial)) return trial;
  Plan(*table_, protocol_, options_, seed_, stream, threads_, &trial);
  ExecuteAll(&trial);
  return trial;
}

PhysicsTrial PhysicsTrials::Try(const TriangleMesh& mesh, std::uint64_t stream,
                                const std::vector<ProposedGrasp>& grasps) {
  PhysicsTrial trial;
  if (!Place(mesh, &trial)) return trial;
  const int executions =
      protocol_.choice == GraspChoice::kBestUnused ? options_.series.executions : options_.draws;
  TrialPlan plan = table_->Proposed(grasps, seed_, stream, executions, !protocol_.table);
  trial.wanted = plan.wanted;
  trial.candidates = plan.candidates;
  for (TrialGrasp& grasp : plan.grasps) trial.grasps.push_back({std::move(grasp), 0, {}});
  ExecuteAll(&trial);
  return trial;
}

void PhysicsTrials::ExecuteAll(PhysicsTrial* trial) {
  const auto model = ParallelJaws({table_->mesh(), table_->scene(), table_->com()}, metric_);
  ++engines_->object;
  ParallelFor(std::ssize(trial->grasps), threads_, [&](std::int64_t i) {
    ExecutedGrasp& grasp = trial->grasps[static_cast<std::size_t>(i)];
    Pool::Seat seat = engines_->Take(*body_);
    for (const NoiseDraw& noise : grasp.planned.draws) {
      grasp.draws.push_back(
          {noise.friction, model->ExecutedQuality(grasp.planned.grasp, noise), {}});
      grasp.draws.back().execution = Execute(seat.engine.get(), *body_, options_.physics, protocol_,
                                             StartOfDraw(grasp, grasp.draws.size() - 1), pace_);
    }
    engines_->GiveBack(std::move(seat));
  });
}

GripStart PhysicsTrials::StartOfDraw(const ExecutedGrasp& grasp, std::size_t draw) const {
  return StartOf(*table_, *body_, grasp.planned, grasp.planned.draws[draw], metric_.jaw_opening,
                 protocol_.table);
}

Execution PhysicsTrials::Replay(const ExecutedGrasp& grasp, std::size_t draw,
                                const ReplayFn& replay) {
  Pool::Seat seat = engines_->Take(*body_);
  const Execution execution = Execute(seat.engine.get(), *body_, options_.physics, protocol_,
                                      StartOfDraw(grasp, draw), pace_, replay);
  engines_->GiveBack(std::move(seat));
  return execution;
}

Isometry3d PhysicsTrials::MeshPose(const Isometry3d& body) const {
  Isometry3d mesh = body * body_->from_object;
  mesh.translation() -= mesh.linear() * (table_->scale() * table_->place());
  return mesh;
}

}  // namespace antigrasp
