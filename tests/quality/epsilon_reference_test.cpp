#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/quality/reference_cases.h"

namespace antigrasp {
namespace {

class DexNetReference : public testing::Test {
 protected:
  static void SetUpTestSuite() { cases_ = new std::vector<ReferenceCase>(ReadReferenceCases()); }
  static void TearDownTestSuite() { delete cases_; }
  static const std::vector<ReferenceCase>& Cases() { return *cases_; }

  static double Tolerance(const ReferenceCase& c, double expected) {
    const double norm = std::isfinite(c.matrix_norm) ? c.matrix_norm : 0.0;
    return 1e-9 * std::max(1.0, norm) + 1e-7 * expected;
  }

 private:
  static std::vector<ReferenceCase>* cases_;
};
std::vector<ReferenceCase>* DexNetReference::cases_ = nullptr;

TEST_F(DexNetReference, HasAllFiveHundredRows) { EXPECT_EQ(Cases().size(), 500u); }

TEST_F(DexNetReference, EpsilonMatchesWithDexNetsOwnFrames) {
  for (const ReferenceCase& c : Cases()) {
    const double epsilon = Epsilon(c.contacts, c.com, c.model, c.frames);
    EXPECT_NEAR(epsilon, c.epsilon, Tolerance(c, c.epsilon)) << c.id << " " << c.family;
  }
}

TEST_F(DexNetReference, EpsilonMatchesWithTheContinuumFrame) {
  for (const ReferenceCase& c : Cases()) {
    if (c.cone_status != "ok") continue;
    const double epsilon = Epsilon(c.contacts, c.com, c.model);
    EXPECT_NEAR(epsilon, c.epsilon_own_frame, Tolerance(c, c.epsilon_own_frame))
        << c.id << " " << c.family;
  }
}

TEST_F(DexNetReference, OriginInsideOrNotIsDecidedAlike) {
  int positive = 0;
  for (const ReferenceCase& c : Cases()) {
    if (c.epsilon > 0.0 && c.epsilon < 1e-9) continue;  // too near the boundary to ask
    EXPECT_EQ(Epsilon(c.contacts, c.com, c.model, c.frames) > 0.0, c.epsilon > 0.0) << c.id;
    positive += c.epsilon > 0.0 ? 1 : 0;
  }
  EXPECT_GT(positive, 200);
}

TEST_F(DexNetReference, GraspMatrixHasTheReferenceNorm) {
  for (const ReferenceCase& c : Cases()) {
    if (c.cone_status != "ok") continue;
    const double norm = GraspMatrix(c.contacts, c.com, c.model, c.frames).norm();
    EXPECT_NEAR(norm, c.matrix_norm, 1e-12 * c.matrix_norm) << c.id;
  }
}

TEST_F(DexNetReference, SlipAndNormalForceMatchForEveryJawDirection) {
  int slips = 0;
  for (const ReferenceCase& c : Cases()) {
    if (!c.has_jaw_direction) continue;
    for (std::size_t i = 0; i < 2; ++i) {
      const Eigen::Vector3d u = c.jaw_direction[i].normalized();
      const Eigen::Vector3d d = -c.contacts[i].normal;
      const bool slips_in_reference = c.cone_status.find(i == 0 ? '1' : '2') != std::string::npos;
      EXPECT_EQ(Slips(d, u, c.model.friction), slips_in_reference) << c.id;
      if (!slips_in_reference) {
        EXPECT_NEAR(std::max(u.dot(d), 0.0), c.contacts[i].normal_force, 1e-14) << c.id;
      }
      slips += slips_in_reference ? 1 : 0;
    }
  }
  EXPECT_GT(slips, 10);
}

TEST_F(DexNetReference, TangentFrameIsWithinDexNetsGridStep) {
  for (const ReferenceCase& c : Cases()) {
    for (std::size_t i = 0; i < 2; ++i) {
      const auto frame = TangentFrame(-c.contacts[i].normal);
      if (std::abs(c.contacts[i].normal.x()) > 1.0 - 1e-12) {
        EXPECT_LT((frame[0] - c.frames[i][0]).norm(), 1e-12) << c.id;  // exact there
      } else {
        // Half a step of 2 pi / 1000.
        EXPECT_LT((frame[0] - c.frames[i][0]).norm(), 3.2e-3) << c.id;
      }
    }
  }
}

}  // namespace
}  // namespace antigrasp
