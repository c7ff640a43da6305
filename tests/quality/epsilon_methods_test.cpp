#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "antigrasp/quality/epsilon_closed_form.h"
#include "antigrasp/quality/epsilon_general.h"
#include "tests/quality/facet_oracle.h"
#include "tests/quality/random_grasps.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

std::optional<DualMap> MapOf(const RandomGrasp& grasp) {
  return MakeDualMap(
      grasp.contacts, grasp.com, grasp.model,
      {TangentFrame(-grasp.contacts[0].normal), TangentFrame(-grasp.contacts[1].normal)});
}

void ExpectFacetsAgree(const RandomGrasp& grasp, int* positive, const char* what) {
  const double expected = EpsilonByFacets(GraspMatrix(grasp.contacts, grasp.com, grasp.model));
  const double epsilon = Epsilon(grasp.contacts, grasp.com, grasp.model);
  EXPECT_NEAR(epsilon, expected, 1e-11 + 1e-7 * expected) << what;
  *positive += expected > 0.0 ? 1 : 0;
}

// Compares the closed form on every instruction set with the general method; 1 where both apply.
int CompareMethods(const RandomGrasp& grasp) {
  const auto map = MapOf(grasp);
  EXPECT_TRUE(map.has_value());
  const auto closed = MaxNorm2ClosedForm(*map);
  for (const SimdLevel level : SupportedSimdLevels()) {
    EXPECT_EQ(MaxNorm2ClosedForm(*map, level), closed) << Name(level);
  }
  if (!closed) return 0;
  const auto general = MaxNorm2General(MakeWrenchDual(*map));
  EXPECT_TRUE(general.has_value());
  EXPECT_NEAR(*closed, general.value_or(0.0), 1e-9 * *closed);
  return 1;
}

TEST(EpsilonMethods, ClosedFormEqualsTheGeneralMethodInsideThePyramids) {
  int compared = 0;
  for (std::uint64_t i = 0; i < 6000; ++i) {
    RngStream rng(11, "methods", i);
    const int edges = i % 3 == 0 ? 3 + static_cast<int>(rng.Below(6)) : 8;
    compared += CompareMethods(DrawRandomGrasp(1.0, edges, &rng));
  }
  EXPECT_GT(compared, 3000);
}

TEST(EpsilonMethods, InstructionSetsHaveTheirNamesAndTheBaselineIsAlwaysThere) {
  EXPECT_STREQ(Name(SimdLevel::kBaseline), "baseline");
  EXPECT_STREQ(Name(SimdLevel::kAvx2), "avx2");
  EXPECT_STREQ(Name(SimdLevel::kAvx512), "avx512");
  EXPECT_EQ(SupportedSimdLevels().front(), SimdLevel::kBaseline);
}

TEST(EpsilonMethods, TorsionOfSimilarSizeOnBothContactsUsesTheRidges) {
  // Large fingers and short arms make the torsion rows cross C, which the usual constants do not.
  int compared = 0;
  for (std::uint64_t i = 0; i < 2000; ++i) {
    RngStream rng(12, "ridges", i);
    RandomGrasp grasp = DrawRandomGrasp(0.8, 8, &rng);
    grasp.model.finger_radius = rng.Uniform(0.05, 1.0);
    compared += CompareMethods(grasp);
  }
  EXPECT_GT(compared, 800);
}

TEST(EpsilonMethods, ConesOfMoreThanEightEdgesAgreeWithTheirFacets) {
  int positive = 0;
  for (std::uint64_t i = 0; i < 3; ++i) {
    RngStream rng(15, "facets", i);
    const RandomGrasp grasp = DrawRandomGrasp(0.5, 9, &rng);
    EXPECT_FALSE(MaxNorm2ClosedForm(*MapOf(grasp)).has_value());
    ExpectFacetsAgree(grasp, &positive, "nine edges");
  }
  EXPECT_EQ(positive, 3);
}

TEST(EpsilonMethods, EveryFacetOfTheHullAgreesInsideTheCone) {
  int positive = 0;
  for (std::uint64_t i = 0; i < 400; ++i) {
    RngStream rng(13, "facets", i);
    ExpectFacetsAgree(DrawRandomGrasp(1.0, i % 2 == 0 ? 3 : 4, &rng), &positive, "inside");
  }
  EXPECT_GT(positive, 100);
}

TEST(EpsilonMethods, EveryFacetOfTheHullAgreesOutsideTheConeAndOnTheWrongSide) {
  int positive = 0;
  for (std::uint64_t i = 0; i < 600; ++i) {
    RngStream rng(14, "facets", i);
    RandomGrasp grasp = DrawRandomGrasp(2.0, i % 2 == 0 ? 3 : 4, &rng);
    if (i % 5 == 0) grasp.contacts[0].normal = DrawDirection(&rng);
    if (i % 7 == 0) grasp.com = DrawPoint(1.0, &rng);
    if (i % 3 == 0) grasp.model.finger_radius = rng.Uniform(0.05, 0.5);
    ExpectFacetsAgree(grasp, &positive, "outside");
  }
  EXPECT_GT(positive, 30);
}

TEST(EpsilonMethods, EveryFacetOfTheHullAgreesOnAxisAlignedGrasps) {
  int positive = 0;
  for (int axis = 0; axis < 3; ++axis) {
    for (int offset = 0; offset < 3; ++offset) {
      for (const int edges : {3, 4}) {
        RandomGrasp grasp;
        const Vector3d normal = Vector3d::Unit(axis);
        const Vector3d side = 0.004 * offset * Vector3d::Unit((axis + 1) % 3);
        grasp.contacts = {Contact{-0.02 * normal, -normal, 1.0},
                          Contact{0.02 * normal + side, normal, 1.0}};
        grasp.com = 0.01 * Vector3d::Unit((axis + 2) % 3);
        grasp.model.cone_edges = edges;
        ExpectFacetsAgree(grasp, &positive, "axis aligned");
      }
    }
  }
  EXPECT_GT(positive, 10);
}

TEST(EpsilonMethods, EveryFacetOfTheHullAgreesUnderUniformPressure) {
  int positive = 0;
  for (std::uint64_t i = 0; i < 200; ++i) {
    RngStream rng(16, "facets", i);
    RandomGrasp grasp = DrawRandomGrasp(1.2, i % 2 == 0 ? 3 : 4, &rng);
    grasp.model.torsion = Torsion::kUniformPressure;
    ExpectFacetsAgree(grasp, &positive, "uniform pressure");
  }
  EXPECT_GT(positive, 50);
}

}  // namespace
}  // namespace antigrasp
