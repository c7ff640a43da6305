#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "antigrasp/mesh/triangle_mesh.h"
#include "antigrasp/quality/metric_options.h"
#include "antigrasp/quality/robust_quality.h"

namespace antigrasp {

// A smooth stand-in for graspability, with its derivative by the face normals.
struct ObjectiveOptions {
  int grasps = 200;          // sampled in each step
  int draws = 25;            // noise draws per grasp
  int noise_pool = 4000;     // draws made once per object, from which all steps take theirs
  double cone_width = 0.12;  // grasps are sampled beyond the friction cone by this much, tangents
  double acceptance_softness = 0.04;  // of the cone's rim for the grasp as planned, tangents
  double slip_softness = 0.02;        // added to the spread of friction, tangents
  double percentile_softness = 0.5;   // kernel about the percentile, as a share of it
};

// Both jaws closed once along one line.
struct Closing {
  std::array<std::int32_t, 2> face{};               // that jaw 1 and jaw 2 meet
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();  // jaw 1 moves along it, jaw 2 against it
  // Epsilon as a share of its largest value if nothing slips: 1 / sqrt(1 + (k d)^2), d the distance
  // of the line from the centre of mass, k the torque scale. Two contacts that hold each other lack
  // only torque about their line, which their torsion alone gives: within 10 % of the exact epsilon
  // away from the cone's rim, whatever the normals.
  double reach = 0.0;
};

struct AttackGrasp {
  Closing planned;
  std::vector<Closing> executed;  // the draws in which both jaws meet the object from outside
};

// Grasps as EvaluateGraspability samples them, but from a cone wider by options.cone_width, because
// turning a normal lets in what is now just outside. Mesh in metres. Fewer than options.grasps when
// 20 times as many candidates do not give them.
std::vector<AttackGrasp> SampleAttackGrasps(const TriangleMesh& mesh, const MetricOptions& metric,
                                            const ObjectiveOptions& options,
                                            const std::vector<NoiseDraw>& pool, std::uint64_t seed,
                                            std::uint64_t step);

// For faces with these outward unit normals:
//   S(t, s)  share of friction coefficients under which a contact with tangent t to its normal
//            holds: normal distribution with deviation s about the metric's friction
//   Q_i      mean over the draws of reach * S(larger tangent of the two contacts)
//   w_i      S of the grasp as planned: how much of it is sampled
//   value    the v with sum w_i Phi((v - Q_i) / h) = percentile * sum w_i
// The derivative is exact for this value while the lines meet the same faces: where a face moves to
// is left out, and seen by the next step's sample. Zero normals' faces and no grasps give 0.
struct SmoothPercentile {
  double value = 0.0;
  std::vector<Eigen::Vector3d> by_normal;  // one per face
};
SmoothPercentile EvaluateObjective(const std::vector<AttackGrasp>& grasps,
                                   const std::vector<Eigen::Vector3d>& normals,
                                   const MetricOptions& metric, const ObjectiveOptions& options);

// What physics decides first: whether a grasp slips. With the above and round cones,
//   H_i      mean over the draws of S(larger tangent of the two contacts)
//   value    sum w_i H_i / sum w_i, the share of executions that hold, 0 to 1
// Derivative as above. 0 without grasps.
struct MeanHold {
  double value = 0.0;
  std::vector<Eigen::Vector3d> by_normal;  // one per face
};
MeanHold EvaluateMeanHold(const std::vector<AttackGrasp>& grasps,
                          const std::vector<Eigen::Vector3d>& normals, const MetricOptions& metric,
                          const ObjectiveOptions& options);

// The chain rule: derivative by the vertices from that by the unit normals of the faces.
std::vector<Eigen::Vector3d> DerivativeByVertices(const TriangleMesh& mesh,
                                                  const std::vector<Eigen::Vector3d>& by_normal);

// Outward unit normals of all faces.
std::vector<Eigen::Vector3d> FaceNormals(const TriangleMesh& mesh);

}  // namespace antigrasp
