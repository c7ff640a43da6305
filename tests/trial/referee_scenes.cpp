// Convex solids, tried as `antigrasp trial` does, written to stdout as JSON: every scene with its
// outcome, for another engine to play (referee.mjs). Metres, kilograms, seconds, newtons; poses in
// the gripper's frame (trial/physics_engine.h). With the argument "fixed": nothing decided early.
// With "objects FRICTION GRASPS FOLDER...": the meshes of folders instead, each of 50 g and as the
// convex parts of a bundle (bundle/convex_parts.h), which the other engine can touch.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "antigrasp/bundle/convex_parts.h"
#include "antigrasp/core/choice.h"
#include "antigrasp/core/rng.h"
#include "antigrasp/mesh/convex_hull.h"
#include "antigrasp/mesh/mesh_file.h"
#include "antigrasp/quality/metric_options.h"
#include "antigrasp/trial/execution.h"
#include "antigrasp/trial/gripped_body.h"
#include "antigrasp/trial/physics_trial.h"
#include "antigrasp/trial/trial_table.h"
#include "tests/trial/physics_shapes.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;
using nlohmann::json;

constexpr std::uint64_t kSeed = 7;
constexpr int kGrasps = 16, kDraws = 2;  // of 11 solids: 352 executions
constexpr double kDensity = 1000.0;

TriangleMesh Cuboctahedron(double edge) {
  std::vector<Vector3d> corners;
  for (int skip = 0; skip < 3; ++skip) {
    for (int signs = 0; signs < 4; ++signs) {
      Vector3d corner = Vector3d::Zero();
      corner[(skip + 1) % 3] = (signs & 1) != 0 ? 1.0 : -1.0;
      corner[(skip + 2) % 3] = (signs & 2) != 0 ? 1.0 : -1.0;
      corners.push_back(edge / std::sqrt(2.0) * corner);
    }
  }
  return ConvexHull(corners);
}

std::vector<std::pair<std::string, TriangleMesh>> Solids() {
  return {{"box 30 x 50 x 60", shapes::Box({0.03, 0.05, 0.06})},
          {"box 35 x 40 x 90", shapes::Box({0.035, 0.04, 0.09})},
          {"cube 40", shapes::Box(Vector3d::Constant(0.04))},
          {"bevelled cube, 10 degrees", BevelledCube(10.0, 0.04)},
          {"bevelled cube, 15 degrees", BevelledCube(15.0, 0.04)},
          {"bevelled cube, 26 degrees", BevelledCube(26.0, 0.04)},
          {"cuboctahedron", Cuboctahedron(0.03)},
          {"prism of 12 sides", shapes::Cylinder(0.018, 0.06, 12)},
          {"hull of 12 points", RandomHull(1, 12, {0.022, 0.022, 0.03})},
          {"hull of 30 points", RandomHull(2, 30, {0.02, 0.03, 0.04})},
          {"hull of 80 points", RandomHull(3, 80, {0.02, 0.025, 0.03})}};
}

json Numbers(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }

json Scene(const GripStart& start, const Execution& ours) {
  const Eigen::Quaterniond turn(start.body.linear());
  return {{"place", Numbers(start.body.translation())},
          {"turn", {turn.w(), turn.x(), turn.y(), turn.z()}},
          {"opening", start.opening},
          {"friction", start.friction},
          {"up", Numbers(start.up)},
          {"table", start.table},
          {"outcome", ChoiceName(ours.outcome)},
          {"held", ours.stages > 0},
          {"penetration", ours.penetration}};
}

struct Question {
  MetricOptions metric;
  int draws = 1;
  Pace pace = Pace::kEarly;
  double mass = 0.0;      // kg; 0: by the density
  bool in_parts = false;  // else the hull of the corners
};

// The convex parts as lists of corners in the body's frame.
json Parts(const TriangleMesh& mesh, const Eigen::Isometry3d& to_body, bool in_parts) {
  json parts = json::array();
  std::vector<TriangleMesh> meshes;
  if (in_parts) {
    for (ConvexPart& part : ConvexParts(mesh, {})) meshes.push_back(std::move(part.mesh));
  } else {
    meshes.push_back(mesh);
  }
  for (const TriangleMesh& part : meshes) {
    parts.push_back(json::array());
    for (const Vector3d& corner : part.vertices) parts.back().push_back(Numbers(to_body * corner));
  }
  return parts;
}

json Solid(const std::string& name, const TriangleMesh& mesh, std::uint64_t stream,
           const Question& question) {
  Protocol protocol = ProtocolOf(ProtocolName::kSixWays);
  protocol.stages.resize(1);
  const PhysicsTrialOptions options;
  const auto table = MakeTrialTable(mesh, question.metric, options.series.table);
  if (table == nullptr)
    return {{"name", name}, {"parts", json::array()}, {"scenes", json::array()}};
  const GrippedBody body = MakeGrippedBody(table->mesh());
  const double mass = question.mass > 0.0 ? question.mass : kDensity * body.volume;
  const auto engine = MakeMujocoEngine(options.physics);
  engine->Load(body, mass);
  json scenes = json::array();
  const TrialPlan plan = table->All(kSeed, stream, question.draws);
  for (std::size_t grasp = 0; grasp < plan.grasps.size(); ++grasp) {
    for (std::size_t draw = 0; draw < plan.grasps[grasp].draws.size(); ++draw) {
      const GripStart start =
          StartOf(*table, body, plan.grasps[grasp], plan.grasps[grasp].draws[draw],
                  question.metric.jaw_opening, true);
      scenes.push_back(Scene(
          start, Execute(engine.get(), body, options.physics, protocol, start, question.pace)));
      scenes.back()["grasp"] = grasp;
      scenes.back()["draw"] = draw;
    }
  }
  return {{"name", name},
          {"parts", Parts(table->mesh(), body.from_object, question.in_parts)},
          {"mass", mass},
          {"inertia", Numbers(mass / body.volume * body.inertia)},
          {"scenes", scenes}};
}

json ConvexSolids(Pace pace) {
  Question question;
  question.metric.friction = 0.3;
  question.metric.object_min_extent = 0.0;  // of the size that they have
  question.metric.num_grasps = kGrasps;
  question.metric.num_draws = question.draws = kDraws;
  question.pace = pace;
  json solids = json::array();
  for (const auto& [name, mesh] : Solids()) {
    solids.push_back(Solid(name, mesh, solids.size(), question));
  }
  return solids;
}

// Objects of one name in two folders get the same random draws.
json ObjectsOf(const std::vector<std::string>& folders, double friction, int grasps) {
  namespace fs = std::filesystem;
  Question question;
  question.metric.friction = friction;
  question.metric.num_grasps = grasps;
  question.mass = 0.05;
  question.in_parts = true;
  json solids = json::array();
  for (const std::string& folder : folders) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    for (const fs::path& file : files) {
      solids.push_back(Solid(file.stem().string(), ReadMesh(file.string()),
                             HashOf(file.stem().string()), question));
      solids.back()["group"] = folder;
    }
  }
  return solids;
}

json Everything(json solids) {
  const PhysicsOptions physics;
  const Protocol protocol = ProtocolOf(ProtocolName::kSixWays);
  return {{"engine", MujocoVersion()},
          {"tip_radius", physics.tip.radius},
          {"torsion", physics.tip.Torsion()},
          {"force", physics.force},
          {"close_speed", physics.close_speed},
          {"finger_mass", physics.finger_mass},
          {"table_friction", physics.table_friction},
          {"time_step", physics.time_step},
          {"gravity", kGravity},
          {"close_seconds", protocol.close_seconds},
          {"lift_height", protocol.lift_height},
          {"load_seconds", protocol.stages[0].seconds},
          {"solids", solids}};
}

}  // namespace
}  // namespace antigrasp

int main(int argc, char** argv) {
  using namespace antigrasp;  // NOLINT
  const std::vector<std::string> words(argv + 1, argv + argc);
  const bool of_objects = words.size() > 3 && words[0] == "objects";
  const bool fixed = !words.empty() && words[0] == "fixed";
  std::cout << Everything(of_objects ? ObjectsOf({words.begin() + 3, words.end()},
                                                 std::stod(words[1]), std::stoi(words[2]))
                                     : ConvexSolids(fixed ? Pace::kFixed : Pace::kEarly))
            << "\n";
}
