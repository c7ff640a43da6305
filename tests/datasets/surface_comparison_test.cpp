#include "antigrasp/datasets/surface_comparison.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "antigrasp/core/rng.h"
#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

using Meshes = std::vector<TriangleMesh>;

// Boxes of random sides in [0.3, 1.5].
Meshes Boxes(int count, std::uint64_t seed) {
  RngStream rng(seed, "boxes");
  Meshes meshes;
  for (int i = 0; i < count; ++i) {
    const double x = rng.Uniform(0.3, 1.5), y = rng.Uniform(0.3, 1.5), z = rng.Uniform(0.3, 1.5);
    meshes.push_back(shapes::Box({x, y, z}));
  }
  return meshes;
}

SurfaceComparisonOptions Coarse(int threads = 0) {
  SurfaceComparisonOptions options;
  options.points = 512;
  options.threads = threads;
  return options;
}

TEST(CompareSurfaces, FindsThePermutedSetItself) {
  const Meshes set = Boxes(20, 1);
  Meshes permuted = set;
  std::rotate(permuted.begin(), permuted.begin() + 7, permuted.end());
  const SurfaceComparison same = CompareSurfaces(permuted, set, {}, Coarse());
  EXPECT_EQ(same.sets.coverage, 1.0);
  EXPECT_EQ(same.sets.nna, 0.0);
  // As far as two samplings of the same shapes.
  EXPECT_NEAR(same.sets.matching, same.reference.floor, 0.03 * same.reference.floor);
  EXPECT_NEAR(same.spread.diversity, 1.0, 0.01);
  EXPECT_NEAR(same.samples.vendi, same.reference.vendi, 0.3);
  EXPECT_NEAR(same.samples.size, same.reference.size, 1e-12);
  EXPECT_NEAR(same.samples.roughness, same.reference.roughness, 1e-9);
  EXPECT_EQ(same.normals->coverage, 1.0);
  EXPECT_EQ(same.normals->nna, 0.0);
  EXPECT_NEAR(same.dihedral_distance, 0.0, 1e-9);
  EXPECT_NEAR(same.samples.flat, same.reference.flat, 1e-12);
  EXPECT_FALSE(same.memorisation.has_value());
}

TEST(CompareSurfaces, AShapesPointsAreThoseOfItsStreamAtAnyPlace) {
  const Meshes samples = Boxes(2, 1), reference = Boxes(2, 2), training = Boxes(2, 3);
  const auto turned = [](auto set) {
    std::reverse(set.begin(), set.end());
    return set;
  };
  const SurfaceStreams streams{{1, 2}, {3, 4}, {5, 6}};
  const auto compare = [&](const Meshes& a, const Meshes& b, const Meshes& c,
                           const SurfaceStreams& own) {
    return CompareSurfaces(a, b, c, Coarse(), nullptr, own);
  };
  const SurfaceComparison one = compare(samples, reference, training, streams),
                          two = compare(turned(samples), turned(reference), turned(training),
                                        {{2, 1}, {4, 3}, {6, 5}});
  EXPECT_EQ(one.spread.samples.mean_distance, two.spread.samples.mean_distance);
  EXPECT_EQ(one.samples.floor, two.samples.floor);
  EXPECT_EQ(one.reference.floor, two.reference.floor);
  EXPECT_EQ(one.memorisation->samples, two.memorisation->samples);
  // Each set's numbers are its own.
  const SurfaceComparison others = compare(samples, reference, training, {{1, 9}, {3, 4}, {5, 6}}),
                          trained = compare(samples, reference, training, {{1, 2}, {3, 4}, {5, 9}}),
                          held = compare(samples, reference, training, {{1, 2}, {9, 4}, {5, 6}});
  EXPECT_NE(others.samples.floor, one.samples.floor);
  EXPECT_EQ(others.reference.floor, one.reference.floor);
  EXPECT_NE(held.reference.floor, one.reference.floor);
  EXPECT_EQ(held.samples.floor, one.samples.floor);
  EXPECT_NE(trained.memorisation->samples, one.memorisation->samples);
}

TEST(CompareSurfaces, WeighsNormalsByTheReferencesMeanDiagonalOrNotAtAll) {
  const Meshes samples = Boxes(6, 1), reference = Boxes(6, 2);
  SurfaceComparisonOptions options = Coarse();
  options.normals = 0.5;
  const SurfaceComparison found = CompareSurfaces(samples, reference, {}, options);
  const double length = 0.5 * found.reference.size / (2 * std::sqrt(3.0));
  std::vector<OrientedPointSet> points;
  const Eigen::Vector3d place = Eigen::Vector3d::Zero();  // boxes lie around it
  for (std::uint64_t i = 0; i < 12; ++i) {
    points.push_back(OrientedSurfacePoints(i < 6 ? samples[i] : reference[i - 6], 512, 1, i / 6,
                                           i % 6, length, place));
  }
  const DistanceMatrix all = ChamferMatrix(points, 1);
  const SetComparison expected =
      CompareSets(all.topLeftCorner(6, 6), all.topRightCorner(6, 6), all.bottomRightCorner(6, 6));
  EXPECT_NEAR(found.normals->matching, expected.matching, 1e-6);
  EXPECT_NEAR(found.normals->within_reference, expected.within_reference, 1e-6);
  EXPECT_GT(found.normals->matching, 1.05 * found.sets.matching);
  options.normals = 0.0;
  const SurfaceComparison without = CompareSurfaces(samples, reference, {}, options);
  EXPECT_FALSE(without.normals.has_value());
  EXPECT_EQ(without.sets.matching, found.sets.matching);
}

TEST(NormalLength, OfABallIsItsRadius) {
  EXPECT_NEAR(NormalLength(1.0, Bounds(shapes::Box({6, 6, 6})).Extent().norm()), 3.0, 1e-12);
  EXPECT_NEAR(NormalLength(0.5, std::sqrt(12.0)), 0.5, 1e-12);
}

TEST(CompareSurfaces, SeesOneShapeRepeated) {
  const Meshes reference = Boxes(20, 1), repeated(20, reference[3]);
  const SurfaceComparison found = CompareSurfaces(repeated, reference, {}, Coarse());
  EXPECT_LE(found.sets.coverage, 0.1);
  EXPECT_EQ(found.spread.samples.duplicates, 1.0);
  EXPECT_LT(found.spread.diversity, 0.05);
  EXPECT_NEAR(found.samples.vendi, 1.0, 0.15);  // chance, beyond the floors
  EXPECT_GT(found.reference.vendi, 3.0);
}

TEST(CompareSurfaces, SeesSamplesCopiedFromTheTrainingShapes) {
  const Meshes training = Boxes(40, 1), held_out = Boxes(20, 2), fresh = Boxes(20, 3);
  const Meshes copied(training.begin(), training.begin() + 20);
  const auto of = [&](const Meshes& samples) {
    return *CompareSurfaces(samples, held_out, training, Coarse()).memorisation;
  };
  const Memorisation copies = of(copied), others = of(fresh);
  EXPECT_EQ(copies.nearer, 1.0);
  EXPECT_LT(copies.samples, 0.6 * copies.reference);
  EXPECT_NEAR(others.nearer, 0.5, 0.3);
  EXPECT_NEAR(others.samples, others.reference, 0.3 * others.reference);
}

TEST(CompareSurfaces, DoesNotChangeWhenAllMoveAlike) {
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  Meshes samples = Boxes(10, 1), reference = Boxes(10, 2);
  const SurfaceComparison before = CompareSurfaces(samples, reference, {}, Coarse());
  for (Meshes* set : {&samples, &reference}) {
    for (TriangleMesh& mesh : *set) {
      mesh = Transformed(shapes::Rotated(mesh, turn), 1.0, {0.5, -1, 0.25});
    }
  }
  const SurfaceComparison after = CompareSurfaces(samples, reference, {}, Coarse());
  EXPECT_EQ(after.sets.coverage, before.sets.coverage);
  EXPECT_EQ(after.sets.nna, before.sets.nna);
  EXPECT_NEAR(after.sets.matching, before.sets.matching, 1e-6);
  EXPECT_NEAR(after.samples.vendi, before.samples.vendi, 1e-4);
  EXPECT_NEAR(after.samples.roughness, before.samples.roughness, 1e-9);
}

TEST(CompareSurfaces, GivesTheSameBitsAtAnyThreadCount) {
  const Meshes samples = Boxes(9, 1), reference = Boxes(9, 2), training = Boxes(5, 3);
  const SurfaceComparison one = CompareSurfaces(samples, reference, training, Coarse(1));
  const SurfaceComparison four = CompareSurfaces(samples, reference, training, Coarse(4));
  EXPECT_EQ(one.sets.matching, four.sets.matching);
  EXPECT_EQ(one.spread.samples.mean_distance, four.spread.samples.mean_distance);
  EXPECT_EQ(one.samples.vendi, four.samples.vendi);
  EXPECT_EQ(one.samples.roughness, four.samples.roughness);
  EXPECT_EQ(one.samples.floor, four.samples.floor);
  EXPECT_EQ(one.normals->matching, four.normals->matching);
  EXPECT_EQ(one.dihedral_distance, four.dihedral_distance);
  EXPECT_EQ(one.memorisation->samples, four.memorisation->samples);
}

TEST(CompareSurfaces, ComparesTheSameFarFromTheOrigin) {
  const auto moved = [](Meshes meshes) {
    for (TriangleMesh& mesh : meshes) mesh = Transformed(mesh, 1.0, {400000.0, -800000.0, 1000.0});
    return meshes;
  };
  const Meshes samples = Boxes(4, 1), reference = Boxes(4, 2), training = Boxes(4, 3);
  const SurfaceComparison here = CompareSurfaces(samples, reference, training, Coarse());
  const SurfaceComparison there =
      CompareSurfaces(moved(samples), moved(reference), moved(training), Coarse());
  const double distance = here.spread.median_distance;
  EXPECT_NEAR(there.spread.median_distance, distance, 1e-5 * distance);
  EXPECT_NEAR(there.samples.vendi, here.samples.vendi, 1e-4);
  EXPECT_NEAR(there.memorisation->samples, here.memorisation->samples, 1e-5);
}

}  // namespace
}  // namespace antigrasp
