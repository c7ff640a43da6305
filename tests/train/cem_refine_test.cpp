// Runs whose elites are changed before they are learnt from.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>

#include "antigrasp/core/error.h"
#include "antigrasp/datasets/shape_set.h"
#include "antigrasp/train/cem_run.h"
#include "tests/support/shapes.h"
#include "tests/support/temp_folder.h"
#include "tests/train/run_files.h"
#include "tests/train/tiny_run.h"

namespace antigrasp {
namespace {

using shapes::StoppingObserver;
using shapes::TempFolder;

TEST(CemRefine, ElitesAreRefinedInTheRunAndNotInItsControl) {
  const TempFolder folder;
  StoppingObserver observer;
  RunConfig config = shapes::Tiny();
  config.cem.episodes = 1;
  config.cem.prior_fraction = 0.0;
  config.cem.control = true;
  config.cem.refine_steps = 3;
  EXPECT_THROW(StartRun(config, folder / "run", &observer), InputError);
  std::atomic<int> refined = 0;
  const TriangleMesh sphere = shapes::Sphere(0.3, 3);
  const MeshRefiner rounded = [&](const TriangleMesh&, const RunConfig& of, const BoundingBox&,
                                  std::uint64_t) {
    EXPECT_EQ(of.cem.select, EliteOrder::kGraspability);
    ++refined;
    return sphere;
  };
  const RunResult result =
      StartRun(config, folder / "run", &observer, MakeGan, {nullptr, InThreads(rounded)});
  const RunFolder run{folder / "run"};
  int elites = 0;
  for (int episode = 0; episode <= config.cem.episodes; ++episode) {
    elites += static_cast<int>(ReadShapeSet(run.Elites(episode)).grids.size());
  }
  EXPECT_GT(elites, 0);
  EXPECT_EQ(refined, elites);
  EXPECT_EQ(ConfigOfRun(run.Control()).cem.refine_steps, 0);
  // What the next episode learns from are spheres of 4/3 pi 0.3^3 32^3 nodes.
  for (const SdfGrid& grid : ReadShapeSet(run.Elites(0)).grids) {
    const auto inside =
        std::count_if(grid.values.begin(), grid.values.end(), [](float v) { return v > 0.0F; });
    EXPECT_NEAR(static_cast<double>(inside), 3706.0, 60.0);
  }
}

}  // namespace
}  // namespace antigrasp
