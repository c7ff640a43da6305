#pragma once

#include <array>
#include <optional>
#include <span>
#include "antigrasp/core/choice.h"
#include "antigrasp/core/rng.h"
#include "antigrasp/perturb/editable_mesh.h"
#include "antigrasp/perturb/face_pairs.h"
#include "antigrasp/perturb/sum_tree.h"

namespace antigrasp {

// How a pair of antipodal faces is drawn without listing F_a.
enum class PairDraw {
  kUniform,  // every pair of F_a alike: two faces at random until they are antipodal
  kArea,     // the same, faces in proportion to their areas
  kRay       // as grasps are sampled: a point uniform over the area, a direction uniform in its
             // friction cone, the face through which that ray leaves the object
};
constexpr auto ChoicesOf(PairDraw) {
  return std::to_array<Choice<PairDraw>>(
      {{PairDraw::kUniform, "uniform"}, {PairDraw::kArea, "area"}, {PairDraw::kRay, "ray"}});
}

// Exact on the mesh as it is now. Rejection costs 1-3 us a pair while a few percent of all pairs
// are antipodal, a ray 1-2 us.
class PairSampler {
 public:
  // The mesh must outlive the sampler.
  PairSampler(const EditableMesh& mesh, const PairLimits& limits, PairDraw draw);

  struct Pair {
    std::int32_t first, second;
  };
  // Nothing after 100,000 tries (rays: 10,000) in vain: the mesh has no pair, or hardly any.
  std::optional<Pair> Draw(RngStream* rng) const;

  void Update(std::span<const std::int32_t> changed_faces);  // their areas

 private:
  std::int32_t DrawFace(RngStream* rng) const;
  std::optional<Pair> DrawByRejection(RngStream* rng) const;
  std::optional<Pair> DrawByRay(RngStream* rng) const;

  const EditableMesh& mesh_;
  AntipodalTest test_;
  PairDraw draw_;
  SumTree areas_;
};

}  // namespace antigrasp
