// Which measure of a comparison sees which fault: prisms spoilt on purpose, as in
// docs/similarity.md.
#include <gtest/gtest.h>

#include <algorithm>

#include "antigrasp/core/rng.h"
#include "antigrasp/datasets/prior_set.h"
#include "antigrasp/datasets/roughness.h"
#include "antigrasp/datasets/surface_comparison.h"
#include "antigrasp/sdf/remesh.h"

namespace antigrasp {
namespace {

using Grids = std::vector<SdfGrid>;

Grids Prisms(std::uint64_t seed, int grafts = 2) {
  return MakePriorSet({.kind = "prisms", .count = 18, .seed = seed, .grafts = grafts}).grids;
}

const Grids& Exact() {
  static const Grids grids = Prisms(1);
  return grids;
}

// White noise, deviation in cells.
Grids Noisy(Grids grids, double cells) {
  for (std::size_t i = 0; i < grids.size(); ++i) {
    RngStream rng(1, "noise", i);
    for (float& value : grids[i].values) {
      value += static_cast<float>(cells * grids[i].spacing * rng.Normal());
    }
  }
  return grids;
}

// Every node by (1 2 1) / 4 of its neighbours along each axis, twice: deviation of 1 cell.
Grids Rounded(Grids grids) {
  for (SdfGrid& grid : grids) {
    for (int pass = 0; pass < 6; ++pass) {
      const std::vector<float> from = grid.values;
      const std::size_t step = pass % 3 == 0   ? 1
                               : pass % 3 == 1 ? grid.Index(0, 1, 0)
                                               : grid.Index(0, 0, 1);
      for (std::size_t i = step; i + step < from.size(); ++i) {  // shapes stay off the border
        grid.values[i] = 0.25F * (from[i - step] + 2.0F * from[i] + from[i + step]);
      }
    }
  }
  return grids;
}

std::vector<TriangleMesh> Solids(const Grids& grids) {
  std::vector<TriangleMesh> meshes;
  for (const SdfGrid& grid : grids) {
    RemeshResult result = Remesh(grid);
    if (result.ok()) meshes.push_back(std::move(result.mesh));
  }
  return meshes;
}

SurfaceComparison Compared(const Grids& samples, const Grids& reference) {
  std::vector<TriangleMesh> a = Solids(samples), b = Solids(reference);
  a.resize(std::min(a.size(), b.size()));
  b.resize(a.size());
  EXPECT_GE(a.size(), 15U);  // few are torn apart
  SurfaceComparisonOptions options;
  options.points = 512;
  return CompareSurfaces(a, b, {}, options);
}

TEST(SpoiltShapes, NoiseTakesFlatEdgesAndLeavesCreases) {
  const Grids& exact = Exact();
  const SurfaceComparison one = Compared(Noisy(exact, 0.01), exact),
                          two = Compared(Noisy(exact, 0.02), exact),
                          five = Compared(Noisy(exact, 0.05), exact);
  EXPECT_LT(two.samples.flat, 0.8 * two.reference.flat);
  EXPECT_LT(two.samples.flat, one.samples.flat);
  EXPECT_LT(five.samples.flat, 0.5 * two.reference.flat);
  EXPECT_NEAR(two.samples.crease, two.reference.crease, 0.05 * two.reference.crease);
  EXPECT_GT(two.samples.roughness, two.reference.roughness);
  EXPECT_GT(two.dihedral_distance, 1.0);
  EXPECT_LT(one.dihedral_distance, two.dihedral_distance);
  EXPECT_GT(five.dihedral_distance, 2 * two.dihedral_distance);
}

TEST(SpoiltShapes, RoundedEdgesTakeCreasesAndLowerTheRoughness) {
  const Grids& exact = Exact();
  const SurfaceComparison found = Compared(Rounded(exact), exact);
  EXPECT_LT(found.samples.crease, 0.5 * found.reference.crease);
  EXPECT_LT(found.samples.roughness, found.reference.roughness);
  EXPECT_GT(found.dihedral_distance, 2.0);
}

TEST(SpoiltShapes, MissingGraftsAreSeenByPlacesAndLumpsAreNot) {
  const Grids held_out = Prisms(2);
  const SurfaceComparison exact = Compared(Exact(), held_out),
                          lumpy = Compared(Noisy(Exact(), 0.02), held_out),
                          bare = Compared(Prisms(1, 0), held_out);
  EXPECT_GT(bare.sets.nna, exact.sets.nna + 0.2);
  EXPECT_GT(bare.normals->nna, exact.normals->nna + 0.1);
  EXPECT_LT(bare.samples.size, 0.95 * exact.samples.size);
  // Faces get no less flat, and no crease rounder.
  EXPECT_GT(bare.samples.flat, exact.samples.flat);
  EXPECT_NEAR(lumpy.sets.nna, exact.sets.nna, 0.1);
  EXPECT_LT(exact.dihedral_distance, 0.5 * lumpy.dihedral_distance);
}

}  // namespace
}  // namespace antigrasp
