// Surfaces whose distances are known on paper: unit squares across z, so that the distance of two
// is that of their heights, and spheres, whose samplings are half the spacing of the points apart.
#include <gtest/gtest.h>

#include <cmath>

#include "antigrasp/datasets/roughness.h"
#include "antigrasp/datasets/surface_comparison.h"
#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

using Meshes = std::vector<TriangleMesh>;

Meshes Plates(const std::vector<double>& heights) {
  Meshes plates;
  for (const double z : heights) {
    plates.push_back(Transformed(shapes::FlatSquare(), 1.0, {0, 0, z}));
  }
  return plates;
}

SurfaceComparison ComparePlates(const std::vector<double>& samples,
                                const std::vector<double>& reference,
                                const std::vector<double>& training = {}) {
  SurfaceComparisonOptions options;
  options.points = 256;
  return CompareSurfaces(Plates(samples), Plates(reference), Plates(training), options);
}

// Points of plates miss each other sideways by f: sqrt(d^2 + f^2) apart, 0.0005 more than 1.
constexpr double kSideways = 1e-3;

TEST(CompareSurfaces, OfPlatesIsByHand) {
  const SurfaceComparison found = ComparePlates({0, 9, 12}, {10, 20, 40});
  EXPECT_DOUBLE_EQ(found.sets.coverage, 1.0 / 3);  // all three are nearest to 10
  EXPECT_NEAR(found.sets.matching, (1 + 8 + 28) / 3.0, kSideways);
  EXPECT_NEAR(found.sets.to_reference, (10 + 1 + 2) / 3.0, kSideways);
  EXPECT_NEAR(found.sets.within_reference, (10 + 10 + 20) / 3.0, kSideways);
  EXPECT_DOUBLE_EQ(found.sets.nna, 2.0 / 6);  // 0 (9 < 10) and 40 (20 < 28)
  EXPECT_NEAR(found.spread.samples.mean_distance, (9 + 12 + 3) / 3.0, kSideways);
  EXPECT_NEAR(found.spread.reference.mean_distance, (10 + 30 + 20) / 3.0, kSideways);
  EXPECT_NEAR(found.spread.diversity, 24.0 / 60, kSideways);
  EXPECT_NEAR(found.spread.median_distance, 20.0, kSideways);
  // Nearer than half of 10: 9 and 12.
  EXPECT_DOUBLE_EQ(found.spread.samples.duplicates, 2.0 / 3);
  EXPECT_DOUBLE_EQ(found.spread.reference.duplicates, 0.0);
}

// Vendi score of two shapes, from their one number of the kernel.
double VendiOfTwo(double k) {
  const double p = 0.5 * (1 + k), q = 0.5 * (1 - k);
  return std::exp(-p * std::log(p) - q * std::log(q));
}

TEST(CompareSurfaces, ScalesBothVendiScoresByHalfTheReferencesMedian) {
  const SurfaceComparison found = ComparePlates({0, 4}, {0, 8});  // scale 8 / 2
  EXPECT_NEAR(found.samples.vendi, VendiOfTwo(std::exp(-0.5)), 1e-3);
  EXPECT_NEAR(found.reference.vendi, VendiOfTwo(std::exp(-2.0)), 1e-3);
}

TEST(CompareSurfaces, TakesTheFloorsOffTheSpreadsAlone) {
  // Four samplings of one plate: 256 points a unit square miss each other by about 1/32.
  const SurfaceComparison same = ComparePlates({0, 0}, {0, 0});
  EXPECT_GT(same.sets.matching, 0.028);
  EXPECT_LT(same.spread.samples.mean_distance, 0.015);
  EXPECT_LT(same.spread.reference.mean_distance, 0.015);
}

TEST(CompareSurfaces, OfCopiedPlatesIsByHand) {
  // To the nearest of 0 and 50: 1, 9, 12 and 10, 20, 10, of which 10 is the median.
  const Memorisation found = *ComparePlates({1, 9, 12}, {10, 20, 40}, {0, 50}).memorisation;
  EXPECT_NEAR(found.samples, (1 + 9 + 12) / 3.0, kSideways);
  EXPECT_NEAR(found.reference, (10 + 20 + 10) / 3.0, kSideways);
  EXPECT_DOUBLE_EQ(found.nearer, 2.0 / 3);
}

TEST(CompareSurfaces, MeasuresCopiesByTheReferencesLowerMedian) {
  const Memorisation found = *ComparePlates({1, 2, 3, 4}, {1.5, 2.5, 3.5, 10}, {0}).memorisation;
  EXPECT_DOUBLE_EQ(found.nearer, 2.0 / 4);  // 1 and 2; 3 is nearer than the upper one, 3.5
}

TEST(CompareSurfaces, LooksAtEachSetByItself) {
  SurfaceComparisonOptions options;
  options.points = 512;
  const Meshes samples = {shapes::Sphere(1.0, 2), shapes::Sphere(3.0, 2)};
  const Meshes reference = {shapes::Box({2, 3, 6}), shapes::Box({2, 3, 6})};
  const SurfaceComparison found = CompareSurfaces(samples, reference, {}, options);
  // Boxes about the spheres of 2 and 6, and the box itself, whose diagonal is 7.
  EXPECT_NEAR(found.samples.size, 4 * std::sqrt(3.0), 0.01 * 4 * std::sqrt(3.0));
  EXPECT_DOUBLE_EQ(found.reference.size, 7.0);
  const double right = 4 * (2 + 3 + 6);
  const double flat = 2 * (std::sqrt(4.0 + 9) + std::sqrt(4.0 + 36) + std::sqrt(9.0 + 36));
  EXPECT_NEAR(found.reference.roughness, 90 * right / (right + flat), 1e-9);
  EXPECT_NEAR(found.samples.roughness, MeanDihedralAngle(samples[0]), 1e-9);
}

// A floor is half the spacing of the points: it grows with the sphere, falls with the number.
TEST(CompareSurfaces, MeasuresEachSetsFloorOnThatSet) {
  SurfaceComparisonOptions options;
  options.points = 512;
  const Meshes samples = {shapes::Sphere(1.0, 3), shapes::Sphere(1.0, 3)};
  const Meshes reference = {shapes::Sphere(2.0, 3), shapes::Sphere(2.0, 3)};
  const SurfaceComparison found = CompareSurfaces(samples, reference, {}, options);
  const double expected = 0.5 * std::sqrt(4 * M_PI / 512);
  EXPECT_NEAR(found.samples.floor, expected, 0.05 * expected);
  EXPECT_NEAR(found.reference.floor, 2 * expected, 0.05 * 2 * expected);
  options.points = 2048;
  const double finer = CompareSurfaces(samples, reference, {}, options).samples.floor;
  EXPECT_NEAR(finer, 0.5 * expected, 0.05 * 0.5 * expected);
}

PointSet Points(const TriangleMesh& mesh, std::uint64_t set, std::uint64_t shape) {
  return SurfacePoints(mesh, 64, 9, set, shape);
}

// The sets' streams are 0 samples, 1 reference, 2 training, 3 and 4 the second samplings; the
// second number is the shape's place in its set.
TEST(CompareSurfaces, DrawsEverySetFromAStreamOfItsOwn) {
  const TriangleMesh cube = shapes::Cube();
  const Meshes two = {cube, cube};
  SurfaceComparisonOptions options;
  options.points = 64;
  options.seed = 9;
  const SurfaceComparison found = CompareSurfaces(two, two, {cube}, options);
  const auto apart = [&](std::uint64_t set, std::uint64_t i, std::uint64_t other, std::uint64_t j) {
    return Chamfer(Points(cube, set, i), Points(cube, other, j));
  };
  EXPECT_DOUBLE_EQ(found.samples.floor, 0.5 * (apart(0, 0, 3, 0) + apart(0, 1, 3, 1)));
  EXPECT_DOUBLE_EQ(found.reference.floor, 0.5 * (apart(1, 0, 4, 0) + apart(1, 1, 4, 1)));
  EXPECT_DOUBLE_EQ(found.memorisation->samples, 0.5 * (apart(0, 0, 2, 0) + apart(0, 1, 2, 0)));
  EXPECT_DOUBLE_EQ(found.memorisation->reference, 0.5 * (apart(1, 0, 2, 0) + apart(1, 1, 2, 0)));
  EXPECT_FLOAT_EQ(static_cast<float>(found.sets.within_reference),
                  static_cast<float>(apart(1, 0, 1, 1)));
}

TEST(CompareSurfaces, NamesItsPhasesAndCountsThem) {
  SurfaceComparisonOptions options;
  options.points = 16;
  options.threads = 1;
  std::vector<std::string> phases;
  std::vector<std::int64_t> totals;
  CompareSurfaces(Plates({0, 1, 2}), Plates({3, 4, 5}), Plates({6}), options,
                  [&](const std::string& name) -> ProgressFn {
                    phases.push_back(name);
                    totals.push_back(0);
                    return [&](std::int64_t done, std::int64_t total) {
                      EXPECT_EQ(done, ++totals.back());
                      EXPECT_LE(done, total);
                    };
                  });
  EXPECT_EQ(phases, (std::vector<std::string>{"distances", "distances with normals",
                                              "distances to the training shapes"}));
  EXPECT_EQ(totals, (std::vector<std::int64_t>{3, 3, 6}));  // pairs of rows; shapes
}

TEST(CompareSurfaces, RefusesSetsOfOneShapeOrOfOtherSizes) {
  EXPECT_THROW(ComparePlates({0}, {1}), std::logic_error);
  EXPECT_THROW(ComparePlates({0, 1}, {1, 2, 3}), std::logic_error);
}

TEST(SurfaceComparisonOptions, TakeAThousandPointsBySeedOne) {
  const SurfaceComparisonOptions options;
  EXPECT_EQ(options.normals, 1.0);
  EXPECT_EQ(options.points, 1024);
  EXPECT_EQ(options.seed, 1U);
  EXPECT_EQ(options.threads, 0);
}

}  // namespace
}  // namespace antigrasp
