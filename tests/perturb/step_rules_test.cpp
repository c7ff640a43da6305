#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "antigrasp/core/angles.h"
#include "antigrasp/core/error.h"
#include "antigrasp/perturb/antipodal_rotation.h"
#include "antigrasp/perturb/exhaustive.h"
#include "antigrasp/perturb/mesh_change.h"
#include "antigrasp/perturb/random_perturbation.h"
#include "tests/perturb/perturbed_shapes.h"
#include "tests/support/shapes.h"

// Which step is taken, how long it may be and against which normals it is measured.
namespace antigrasp {
namespace {

using Eigen::Vector3d;

PerturbResult Stepped(const TriangleMesh& mesh, const RandomPerturbOptions& options,
                      std::uint64_t seed = 1) {
  RngStream rng(seed, "perturb");
  return PerturbRandomly(mesh, {}, {}, options, &rng);
}

double LargestMove(const PerturbResult& result) {
  double largest = 0.0;
  for (std::size_t v = 0; v < result.mesh.vertices.size(); ++v) {
    largest = std::max(largest, (result.mesh.vertices[v] - result.start.vertices[v]).norm());
  }
  return largest;
}

std::int64_t Refused(const PerturbResult& result, MoveVerdict verdict) {
  return result.refused[static_cast<std::size_t>(verdict)];
}

// A corner of a cube that is lifted turns the top's triangles about a leg at distance 1 or about
// the diagonal, 1 / sqrt 2 away.
TEST(AllowedSteps, OfAMovedCornerAreLessFromTheStartThanFromNow) {
  EditableMesh mesh(shapes::Cube());
  const std::int32_t v = 7;
  std::vector<double> distances;  // of the far edges of the top's triangles around the corner
  for (const std::int32_t f : mesh.FacesOf(v)) {
    if (mesh.Normal(f).z() < 0.5) continue;
    std::vector<Vector3d> others;
    for (const std::int32_t w : mesh.mesh().faces[static_cast<std::size_t>(f)]) {
      if (w != v) others.push_back(mesh.Position(w));
    }
    const Vector3d along = (others[1] - others[0]).normalized();
    const Vector3d to = mesh.Position(v) - others[0];
    distances.push_back((to - to.dot(along) * along).norm());
  }
  ASSERT_FALSE(distances.empty());
  const double lift = 0.0625;  // a number that a float holds
  ASSERT_EQ(mesh.TryMove(v, mesh.Position(v) + Vector3d(0, 0, lift)), MoveVerdict::kOk);
  mesh.Commit();
  double from_start = 1e9, from_now = 1e9, down_from_start = 1e9;
  for (const double d : distances) {
    const double angle = 10 * kDegree;
    from_start = std::min(from_start, d * std::tan(angle) - lift);
    from_now = std::min(from_now, d * std::tan(std::atan(lift / d) + angle) - lift);
    down_from_start = std::min(down_from_start, d * std::tan(angle) + lift);
  }
  const Range within{0.0, 100.0};
  const auto allowed = [&](double z, bool start) {
    return AllowedSteps(mesh, v, Vector3d(0, 0, z), 10 * kDegree, start, within);
  };
  EXPECT_NEAR(allowed(1.0, true).high, from_start, 1e-9);
  EXPECT_NEAR(allowed(1.0, false).high, from_now, 1e-9);
  EXPECT_NEAR(allowed(-1.0, true).high, down_from_start, 1e-9);
  EXPECT_LT(from_start, 0.9 * from_now);
}

TEST(BestStep, IsExactWhereOneFaceMoves) {
  // The face above tilts about y as its corner at x = 1 is lifted, the one below lies flat.
  TriangleMesh mesh =
      shapes::Triangles({{Vector3d(0, 0, 0), Vector3d(0, 1, 0), Vector3d(1, 0, 0)},
                         {Vector3d(1, 0, 2), Vector3d(0, 1, 2), Vector3d(0, -1, 2)}});
  const EditableMesh editable(mesh);
  const Step up = BestStep(editable, 0, 1, 3, Vector3d::UnitZ(), {0.0, 0.25});
  EXPECT_NEAR(up.length, 0.25, 1e-12);
  EXPECT_NEAR(up.angle, std::atan(0.25), 1e-12);
  // Named the other way round it is the same pair.
  EXPECT_NEAR(BestStep(editable, 1, 0, 3, Vector3d::UnitZ(), {0.0, 0.25}).angle, std::atan(0.25),
              1e-12);
  // From below, to where it is level, the angle falls: the best is not to move.
  mesh.vertices[3].z() = 1.75;
  const Step level = BestStep(EditableMesh(mesh), 0, 1, 3, Vector3d::UnitZ(), {0.0, 0.25});
  EXPECT_EQ(level.length, 0.0);
  EXPECT_NEAR(level.angle, std::atan(0.25), 1e-12);
}

TEST(PerturbRandomly, HardlyAnyStepIsTakenBackBecauseItWasMeasuredByOtherNormals) {
  RandomPerturbOptions options;
  options.iterations = 1500;
  const TriangleMesh mesh = shapes::Cylinder(1.0, 3.0, 24);
  const PerturbResult original = Stepped(mesh, options);
  EXPECT_GT(original.moved, 100);
  EXPECT_LE(Refused(original, MoveVerdict::kTurned), original.moved / 100);
  EXPECT_LE(CompareNormals(original.start, original.mesh).largest, 10.0 + 1e-9);
  options.limit = NormalLimit::kStep;
  const PerturbResult step = Stepped(mesh, options);
  EXPECT_GT(step.moved, 100);
  EXPECT_EQ(Refused(step, MoveVerdict::kTurned), 0);  // nothing is measured by the original
  EXPECT_LE(Refused(step, MoveVerdict::kInverted), step.moved / 100);
  EXPECT_GT(CompareNormals(step.start, step.mesh).largest, 20.0);
  for (const PerturbResult* result : {&original, &step}) {
    std::int64_t sum = result->moved + result->no_gain;
    for (const std::int64_t refused : result->refused) sum += refused;
    EXPECT_EQ(sum, 1500);
  }
}

TEST(PerturbRandomly, OneStepTurnsNoFaceByMoreThanAlphaAndOneByAllOfIt) {
  // The largest step along a direction ends where some face has turned by alpha, unless the angle
  // of the pair is largest before: of twenty seeds most end there.
  int at_alpha = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    RandomPerturbOptions options;
    options.alpha = 12.0;
    options.step = StepRule::kLargest;
    options.iterations = 1;
    const PerturbResult result = Stepped(shapes::Cube(), options, seed);
    const double turned = CompareNormals(result.start, result.mesh).largest;
    EXPECT_LE(turned, 12.0);
    at_alpha += turned > 11.97 ? 1 : 0;
  }
  EXPECT_GT(at_alpha, 10);
}

TEST(PerturbRandomly, TheRuleDecidesWhichOfTheSameStepsIsTaken) {
  // Rough, so that few faces are parallel and not every direction raises the angle of a pair.
  RngStream rough(1, "rough");
  const TriangleMesh mesh = shapes::Shaken(shapes::Sphere(1.0, 1), 0.05, &rough);
  int shorter = 0, fewer = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const auto move = [&](StepRule rule) {
      RandomPerturbOptions options;
      options.step = rule;
      options.iterations = 1;
      return Stepped(mesh, options, seed);
    };
    const double smallest = LargestMove(move(StepRule::kSmallest)),
                 largest = LargestMove(move(StepRule::kLargest));
    const double best = LargestMove(move(StepRule::kLargestAngle)),
                 some = LargestMove(move(StepRule::kSmallestOrNone));
    EXPECT_LE(smallest, largest);
    EXPECT_LE(smallest, best);
    EXPECT_LE(best, largest);
    EXPECT_TRUE(some == 0.0 || some == smallest);
    shorter += smallest < largest ? 1 : 0;
    fewer += some < smallest ? 1 : 0;
  }
  EXPECT_GT(shorter, 5);
  EXPECT_GT(fewer, 2);
}

TEST(PerturbRandomly, TheLongestStepIsInMeanEdgesAndIterationsInVertices) {
  // A cube's triangles have edges 1, 1 and sqrt 2.
  RandomPerturbOptions options;
  options.max_step = 0.01;
  options.step = StepRule::kLargest;
  options.iterations = 1;
  const double longest = 0.01 * (2.0 + std::sqrt(2.0)) / 3.0;
  EXPECT_NEAR(LargestMove(Stepped(shapes::Cube(), options)), longest, 1e-6);
  options.iterations = 0;
  options.iterations_per_vertex = 2.5;
  EXPECT_EQ(Stepped(shapes::Cube(), options).iterations, 20);
}

TEST(Validity, TheMeanEdgeIsOverAllSidesOfAllFaces) {
  const double edges =
      (1 + 2 + std::sqrt(5.0)) + (1 + 3 + std::sqrt(10.0)) + (2 + 3 + std::sqrt(13.0));
  EXPECT_NEAR(MeanEdge(shapes::Box({1, 2, 3})), edges / 9.0, 1e-12);
  EXPECT_EQ(MeanEdge({}), 0.0);
  EXPECT_EQ(Name(MoveVerdict::kOk), "ok");
  EXPECT_EQ(Name(MoveVerdict::kNotFinite), "not_finite");
  EXPECT_EQ(Name(MoveVerdict::kTurned), "turned");
  EXPECT_EQ(Name(MoveVerdict::kInverted), "inverted");
  EXPECT_EQ(Name(MoveVerdict::kDegenerate), "degenerate");
}

TEST(PerturbOptions, HaveThePapersDefaultsUnderTheirOwnKeys) {
  PerturbOptions common;
  RandomPerturbOptions random;
  RotationOptions rotation;
  ExhaustiveOptions exhaustive;
  EXPECT_EQ(random.alpha, 10.0);
  EXPECT_EQ(random.directions, 6);
  EXPECT_EQ(random.iterations_per_vertex, 8.0);
  EXPECT_EQ(rotation.beta, 0.075);
  EXPECT_EQ(rotation.max_faces, 350);
  EXPECT_EQ(rotation.max_turn, 60.0);
  EXPECT_EQ(exhaustive.iterations, 64);
  EXPECT_EQ(exhaustive.step, 0.1);
  EXPECT_EQ(exhaustive.directions, 6);
  OptionTable table;
  Bind(&table, &common);
  Bind(&table, &random);
  Bind(&table, &rotation);
  Bind(&table, &exhaustive);
  const std::pair<const char*, double*> keys[] = {
      {"perturb.cone", &common.cone},
      {"perturb.max_width", &common.max_width},
      {"random.alpha", &random.alpha},
      {"random.iterations_per_vertex", &random.iterations_per_vertex},
      {"random.max_step", &random.max_step},
      {"rotation.beta", &rotation.beta},
      {"rotation.iterations_per_face", &rotation.iterations_per_face},
      {"rotation.max_turn", &rotation.max_turn},
      {"exhaustive.step", &exhaustive.step}};
  double value = 0.125;
  for (const auto& [key, field] : keys) {
    table.ApplyOverride(std::string(key) + "=" + std::to_string(value));
    EXPECT_EQ(*field, value) << key;
    value += 0.0625;
  }
  const std::pair<const char*, int*> counts[] = {{"random.directions", &random.directions},
                                                 {"random.iterations", &random.iterations},
                                                 {"rotation.max_faces", &rotation.max_faces},
                                                 {"rotation.iterations", &rotation.iterations},
                                                 {"exhaustive.iterations", &exhaustive.iterations},
                                                 {"exhaustive.directions", &exhaustive.directions}};
  int count = 11;
  for (const auto& [key, field] : counts) {
    table.ApplyOverride(std::string(key) + "=" + std::to_string(count));
    EXPECT_EQ(*field, count++) << key;
  }
  const std::pair<const char*, bool*> switches[] = {
      {"perturb.unchecked", &common.unchecked},
      {"perturb.history", &common.history},
      {"exhaustive.only_if_better", &exhaustive.only_if_better}};
  for (const auto& [key, field] : switches) {
    EXPECT_FALSE(*field) << key;
    table.ApplyOverride(std::string(key) + "=true");
    EXPECT_TRUE(*field) << key;
  }
  table.ApplyOverride("random.limit=step");
  table.ApplyOverride("random.step=largest");
  table.ApplyOverride("random.pairs=area");
  table.ApplyOverride("rotation.pairs=ray");
  EXPECT_EQ(random.limit, NormalLimit::kStep);
  EXPECT_EQ(random.step, StepRule::kLargest);
  EXPECT_EQ(random.pairs, PairDraw::kArea);
  EXPECT_EQ(rotation.pairs, PairDraw::kRay);
  EXPECT_THROW(table.ApplyOverride("random.alpha=90"), InputError);
}

}  // namespace
}  // namespace antigrasp
