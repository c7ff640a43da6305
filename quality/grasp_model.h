#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "antigrasp/core/rng.h"
#include "antigrasp/mesh/ray_scene.h"
#include "antigrasp/mesh/triangle_mesh.h"
#include "antigrasp/quality/contact.h"
#include "antigrasp/quality/execution_noise.h"
#include "antigrasp/quality/metric_options.h"

namespace antigrasp {

// An object to grasp, rescaled: metres. Its mesh has faces, finite vertices and a size.
struct GraspObject {
  const TriangleMesh& mesh;
  const RayScene& scene;
  Eigen::Vector3d com;
};

// A way to grasp one object: what a hand may try, what it reaches and how well it then holds. All
// else of a graspability (attempts, copies, the noise, how many draws, the percentile) is the same
// for every model. Const and thread-safe.
//
// A model with one contact gives a grasp both of whose contacts are that one, of width 0; its axis
// is the direction it presses in.
class GraspModel {
 public:
  virtual ~GraspModel() = default;

  // Why a candidate may be refused, in the order in which people read it: "slip", "jaw blocked".
  // `why` below is a place in this list.
  virtual std::vector<std::string> Reasons() const = 0;

  // One candidate; nullopt and `why` when it is no grasp. As many random numbers each time, so that
  // a candidate of a changed object differs by the change alone.
  virtual std::optional<Grasp> Candidate(RngStream* rng, std::size_t* why) const = 0;

  // Whether the hand gets to a candidate that is no copy; sets grasp->approach where it looks for a
  // way in. Apart from Candidate, because it costs more and is not asked for copies.
  virtual bool Reach(Grasp* grasp, std::size_t* why) const = 0;

  // The quality of the grasp when it is executed under one draw of the noise, 0 = it fails. Called
  // some thousand times per object.
  virtual double ExecutedQuality(const Grasp& grasp, const NoiseDraw& noise) const = 0;

  // The same under many draws, for models that are faster with all of them at hand: qualities[i] is
  // that of draws[i], bit for bit.
  virtual void ExecutedQualities(const Grasp& grasp, std::span<const NoiseDraw> draws,
                                 std::span<double> qualities) const {
    for (std::size_t i = 0; i < draws.size(); ++i) qualities[i] = ExecutedQuality(grasp, draws[i]);
  }
};

// Makes the model of one object, which must outlive it; nullptr when there is nothing to grasp on
// it: no candidate is tried then.
using MakeGraspModel =
    std::function<std::unique_ptr<const GraspModel>(const GraspObject&, const MetricOptions&)>;

}  // namespace antigrasp
