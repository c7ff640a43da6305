#include "antigrasp/ranks/made_together.h"

#include <utility>

#include "antigrasp/core/shared_stream.h"
#include "antigrasp/mesh/pass_mesh.h"
#include "antigrasp/ranks/ranked_model.h"

namespace antigrasp {

void PassFields(Passer& pass, PriorSetOptions& options) {
  pass(options.kind, options.count, options.seed, options.resolution, options.threads,
       options.grafts);
}
void PassFields(Passer& pass, RoughElite& elite) { pass(elite.mesh, elite.seed); }

namespace {

std::vector<TriangleMesh> RefineTogether(WorkShare* share, const MeshRefiner& refine,
                                         const RunConfig& config, BoundingBox within,
                                         std::vector<RoughElite> elites,
                                         const ProgressFn& progress) {
  TellAll(share, &elites);
  TellAll(share, &within);
  std::vector<TriangleMesh> refined;
  StreamShared(
      share, std::ssize(elites), config.threads,
      [&](std::int64_t i) {
        const RoughElite& elite = elites[static_cast<std::size_t>(i)];
        return refine(elite.mesh, config, within, elite.seed);
      },
      [&](std::int64_t, TriangleMesh mesh) { refined.push_back(std::move(mesh)); }, progress);
  return refined;
}

}  // namespace

PriorMaker RankedPrior(RankGroup* group, WorkShare* share) {
  return [=](PriorSetOptions options, const ProgressFn& progress) {
    TellOrHear(group, {Order::kPrior});
    TellAll(share, &options);
    return MakePriorSet(options, progress, share);
  };
}

EliteRefiner RankedRefiner(RankGroup* group, WorkShare* share, MeshRefiner refine) {
  return [=](const std::vector<RoughElite>& elites, const RunConfig& config,
             const BoundingBox& within, const ProgressFn& progress) {
    TellOrHear(group, {Order::kRefine});
    return RefineTogether(share, refine, config, within, elites, progress);
  };
}

void HelpWithPrior(WorkShare* share) {
  PriorSetOptions options;
  TellAll(share, &options);
  MakePriorSet(options, nullptr, share);
}

void HelpRefining(WorkShare* share, const MeshRefiner& refine, const RunConfig& config) {
  RefineTogether(share, refine, config, {}, {}, nullptr);
}

}  // namespace antigrasp
