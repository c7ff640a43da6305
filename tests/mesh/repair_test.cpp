#include "antigrasp/mesh/repair.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "antigrasp/core/rng.h"
#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

bool Did(const RepairResult& result, const std::string& action) {
  return std::find(result.actions.begin(), result.actions.end(), action) != result.actions.end();
}

// Every face with three vertices of its own, as STL stores it.
TriangleMesh Exploded(const TriangleMesh& mesh) {
  TriangleMesh out;
  for (const auto& face : mesh.faces) {
    const auto n = static_cast<std::int32_t>(out.vertices.size());
    for (const auto corner : face) out.vertices.push_back(mesh.vertices[corner]);
    out.faces.push_back({n, n + 1, n + 2});
  }
  return out;
}

TEST(Repair, LeavesASolidAsItIs) {
  const TriangleMesh torus = shapes::Torus(1.0, 0.3, 20, 10);
  const RepairResult result = Repair(torus);
  EXPECT_TRUE(result.accepted());
  EXPECT_TRUE(result.actions.empty());
  EXPECT_EQ(result.mesh.vertices, torus.vertices);
  EXPECT_EQ(result.mesh.faces, torus.faces);
  EXPECT_TRUE(result.report.IsSolid());
}

TEST(Repair, TurnsAnInsideOutMeshOutward) {
  const TriangleMesh sphere = shapes::Sphere(1.0, 2);
  const RepairResult result = Repair(shapes::Inverted(sphere));
  EXPECT_TRUE(result.accepted()) << result.refusal;
  EXPECT_EQ(result.actions, std::vector<std::string>{"turned inside out"});
  EXPECT_DOUBLE_EQ(Volume(result.mesh), Volume(sphere));
}

TEST(Repair, MakesARandomWindingAgree) {
  const TriangleMesh torus = shapes::Torus(1.0, 0.3, 20, 10);
  RngStream rng(5, "winding");
  TriangleMesh mixed = torus;
  int turned = 0;
  for (auto& face : mixed.faces) {
    if (rng.Below(2) == 0) continue;
    std::swap(face[0], face[1]);
    ++turned;
  }
  const RepairResult result = Repair(mixed);
  EXPECT_TRUE(result.accepted()) << result.refusal;
  EXPECT_TRUE(Did(result, "turned " + std::to_string(turned) + " wrongly wound faces"));
  EXPECT_DOUBLE_EQ(result.report.volume, Volume(torus));
}

TEST(Repair, JoinsATriangleSoup) {
  const RepairResult result = Repair(Exploded(shapes::Cube()));
  EXPECT_TRUE(result.accepted()) << result.refusal;
  EXPECT_TRUE(Did(result, "merged 28 duplicate vertices"));
  EXPECT_EQ(result.mesh.vertices.size(), 8u);
}

TEST(Repair, DropsDuplicateDegenerateAndUnusedParts) {
  TriangleMesh mesh = shapes::Cube();
  mesh.faces.push_back({mesh.faces[0][1], mesh.faces[0][2], mesh.faces[0][0]});
  mesh.faces.push_back({mesh.faces[5][1], mesh.faces[5][0], mesh.faces[5][2]});
  mesh.faces.push_back({3, 3, 4});
  mesh.vertices.push_back({8, 8, 8});
  const RepairResult result = Repair(mesh);
  EXPECT_TRUE(result.accepted()) << result.refusal;
  EXPECT_TRUE(Did(result, "removed 2 duplicate faces"));
  EXPECT_TRUE(Did(result, "removed 1 degenerate face"));
  EXPECT_TRUE(Did(result, "removed 1 unused vertex"));
  EXPECT_EQ(result.mesh.faces, shapes::Cube().faces);
}

TEST(Repair, ClosesSeamsThatRoundingOpened) {
  TriangleMesh mesh = Exploded(shapes::Sphere(1.0, 2));
  RngStream rng(9, "seams");
  for (auto& v : mesh.vertices) {
    v += 1e-9 * Eigen::Vector3d(rng.Uniform(), rng.Uniform(), rng.Uniform());
  }
  const RepairResult result = Repair(mesh);
  EXPECT_TRUE(result.accepted()) << result.refusal;
  EXPECT_EQ(result.mesh.vertices.size(), shapes::Sphere(1.0, 2).vertices.size());
  EXPECT_EQ(result.actions.size(), 1u);
  EXPECT_TRUE(result.actions[0].ends_with("nearly equal vertices")) << result.actions[0];
}

TEST(Repair, DoesNotMergeNearVerticesWhereThatWouldNotCloseTheMesh) {
  TriangleMesh mesh = Exploded(shapes::Cube());
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    mesh.vertices[i].x() += 1e-3 * static_cast<double>(i);
  }
  const RepairResult result = Repair(mesh);
  EXPECT_EQ(result.refusal, "open: 36 boundary edges");
  EXPECT_EQ(result.mesh.vertices.size(), 36u);
}

// A cube with a corner set into the middle of an edge, between one face and a zero-area sliver.
TEST(Repair, FlipsAZeroAreaSliverAwayAndStaysClosed) {
  TriangleMesh mesh = shapes::Cube();
  const auto [a, b, c] = mesh.faces[0];
  const auto middle = static_cast<std::int32_t>(mesh.vertices.size());
  mesh.vertices.push_back(0.5 * (mesh.vertices[a] + mesh.vertices[b]));
  mesh.faces[0] = {a, middle, c};
  mesh.faces.push_back({middle, b, c});
  mesh.faces.push_back({a, b, middle});
  ASSERT_TRUE(Inspect(mesh, false).closed);
  ASSERT_EQ(Inspect(mesh, false).degenerate_faces, 1);
  const RepairResult result = Repair(mesh);
  EXPECT_TRUE(result.accepted()) << result.refusal;
  EXPECT_TRUE(Did(result, "flipped the long edge of 1 zero-area face"));
  EXPECT_DOUBLE_EQ(result.report.volume, 1.0);
  EXPECT_DOUBLE_EQ(result.report.area, 6.0);
}

// Two corners on one edge, and two slivers that share a side: the second waits for the first.
TEST(Repair, FlipsAChainOfSliversOneAfterTheOther) {
  TriangleMesh mesh = shapes::Cube();
  const auto [a, b, c] = mesh.faces[0];
  const Eigen::Vector3d from = mesh.vertices[a], edge = mesh.vertices[b] - from;
  mesh.vertices.push_back(from + 0.25 * edge);  // 8
  mesh.vertices.push_back(from + 0.5 * edge);   // 9
  mesh.faces[0] = {a, 8, c};
  mesh.faces.insert(mesh.faces.end(), {{8, 9, c}, {9, b, c}, {a, b, 9}, {a, 9, 8}});
  ASSERT_TRUE(Inspect(mesh, false).closed);
  ASSERT_EQ(Inspect(mesh, false).degenerate_faces, 2);
  const RepairResult result = Repair(mesh);
  EXPECT_TRUE(result.accepted()) << result.refusal;
  EXPECT_TRUE(Did(result, "flipped the long edge of 2 zero-area faces"));
  EXPECT_DOUBLE_EQ(result.report.volume, 1.0);
  EXPECT_DOUBLE_EQ(result.report.area, 6.0);
}

TEST(Repair, NeverInventsSurface) {
  TriangleMesh open = shapes::Sphere(1.0, 1);
  open.faces.pop_back();
  EXPECT_EQ(Repair(open).refusal, "open: 3 boundary edges");
  EXPECT_EQ(Repair(shapes::FlatSquare()).refusal, "open: 4 boundary edges");

  TriangleMesh spike = shapes::Sphere(1.0, 2);
  spike.vertices[0] *= -3.0;
  EXPECT_EQ(Repair(spike).refusal, "self-intersecting");

  const TriangleMesh apart =
      shapes::Joined(shapes::Cube(), Transformed(shapes::Cube(), 1.0, {4, 0, 0}));
  EXPECT_EQ(Repair(apart).refusal, "disjoint pieces: 2");
}

TEST(Repair, RefusesWhatIsNoMeshAtAll) {
  EXPECT_EQ(Repair(TriangleMesh{}).refusal, "empty: no faces");
  TriangleMesh mesh = shapes::Cube();
  mesh.faces[0] = {0, 1, 77};
  EXPECT_TRUE(Repair(mesh).refusal.starts_with("not finite"));
  mesh = shapes::Cube();
  mesh.vertices[0].x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(Repair(mesh).refusal.starts_with("not finite"));
  const TriangleMesh flat{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{{0, 1, 2}, {0, 2, 1}}}};
  EXPECT_FALSE(Repair(flat).accepted());
  const TriangleMesh lines{{{0, 0, 0}, {1, 0, 0}}, {{{0, 1, 1}}}};
  EXPECT_EQ(Repair(lines).refusal, "empty: no faces");
}

TEST(Repair, IsIdempotentOnRandomDamage) {
  for (int trial = 0; trial < 60; ++trial) {
    RngStream rng(21, "damage", trial);
    TriangleMesh mesh = Exploded(shapes::Sphere(1.0, 1));
    for (int i = 0; i < 10; ++i) {
      auto& face = mesh.faces[rng.Below(mesh.faces.size())];
      switch (rng.Below(4)) {
        case 0:
          std::swap(face[0], face[1]);
          break;
        case 1:
          mesh.faces.push_back(face);
          break;
        case 2:
          mesh.faces.push_back({face[0], face[0], face[1]});
          break;
        default:
          mesh.vertices.push_back({rng.Normal(), rng.Normal(), rng.Normal()});
          break;
      }
    }
    const RepairResult once = Repair(mesh);
    EXPECT_TRUE(once.accepted()) << once.refusal;
    const RepairResult twice = Repair(once.mesh);
    EXPECT_TRUE(twice.actions.empty());
    EXPECT_EQ(twice.mesh.faces, once.mesh.faces);
  }
}

// A box of diagonal sqrt(14) with one of the copies of its corner (-.5, -1, -1.5) a step away.
TriangleMesh BoxWithASeam(double step, double scale) {
  TriangleMesh mesh = Exploded(shapes::Box({1, 2, 3}));
  const auto corner =
      std::find(mesh.vertices.rbegin(), mesh.vertices.rend(), Eigen::Vector3d(-0.5, -1.0, -1.5));
  corner->x() += step;
  return Transformed(mesh, scale, Eigen::Vector3d::Zero());
}

// Near is 1e-7 of the diagonal: 3.74e-7 here, at any size of the mesh.
TEST(Repair, ClosesSeamsUpToAShareOfTheDiagonal) {
  for (const double scale : {1.0, 1e-3, 1024.0}) {
    const RepairResult near = Repair(BoxWithASeam(3.6e-7, scale));
    EXPECT_TRUE(near.accepted()) << near.refusal;
    EXPECT_EQ(near.actions, (std::vector<std::string>{"merged 27 duplicate vertices",
                                                      "merged 1 nearly equal vertex"}))
        << "scale " << scale;
    // The first copy in the file is the one that stays.
    EXPECT_EQ(Bounds(near.mesh).min, scale * Eigen::Vector3d(-0.5, -1.0, -1.5));
    EXPECT_EQ(near.mesh.vertices.size(), 8u);
    EXPECT_TRUE(Repair(BoxWithASeam(3.9e-7, scale)).refusal.starts_with("open: "));
  }
}

TEST(Repair, LeavesASeamWhereTheMeshStaysOpenAnyway) {
  TriangleMesh mesh = BoxWithASeam(3.6e-7, 1.0);
  mesh.faces.erase(mesh.faces.begin());
  const RepairResult result = Repair(mesh);
  EXPECT_EQ(result.actions, std::vector<std::string>{"merged 27 duplicate vertices"});
  EXPECT_EQ(result.mesh.vertices.size(), 9u);
  EXPECT_TRUE(result.refusal.starts_with("open: "));
}

TEST(Repair, TellsWhatItDidInTheOrderItWasDone) {
  TriangleMesh mesh = shapes::Cube();
  mesh.vertices.push_back(mesh.vertices[7]);
  mesh.faces[11] = {1, 8, 5};  // {1, 7, 5} over the copy
  mesh.faces.push_back({2, 2, 4});
  mesh.faces.push_back({mesh.faces[3][2], mesh.faces[3][0], mesh.faces[3][1]});
  mesh.vertices.push_back({8, 8, 8});
  mesh.vertices.push_back({8, 8, 9});
  std::swap(mesh.faces[4][0], mesh.faces[4][1]);
  const RepairResult result = Repair(mesh);
  EXPECT_EQ(result.actions,
            (std::vector<std::string>{"merged 1 duplicate vertex", "removed 1 degenerate face",
                                      "removed 1 duplicate face", "removed 2 unused vertices",
                                      "turned 1 wrongly wound face"}));
  EXPECT_EQ(result.mesh.vertices, shapes::Cube().vertices);
  EXPECT_TRUE(result.accepted()) << result.refusal;
}

TEST(Repair, EveryPieceIsTurnedByItself) {
  const TriangleMesh far = Transformed(shapes::Box({1, 2, 3}), 1.0, {9, 0, 0});
  const RepairResult result = Repair(shapes::Joined(shapes::Cube(), shapes::Inverted(far)));
  EXPECT_EQ(result.actions, std::vector<std::string>{"turned 12 wrongly wound faces"});
  EXPECT_DOUBLE_EQ(result.report.volume, 7.0);
  EXPECT_EQ(result.refusal, "disjoint pieces: 2");
}

TEST(Repair, AnOpenBowlMayFaceInward) {
  TriangleMesh bowl = shapes::Inverted(shapes::Tetrahedron());
  bowl.faces.pop_back();
  const RepairResult result = Repair(bowl);
  EXPECT_TRUE(result.actions.empty());
  EXPECT_EQ(result.mesh.faces, bowl.faces);
}

TEST(Repair, TheMajorityOfAnOpenSheetIsRight) {
  TriangleMesh sheet{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}},
                     {{{0, 1, 2}, {0, 3, 2}, {1, 4, 2}}}};
  const RepairResult result = Repair(sheet);
  EXPECT_EQ(result.actions, std::vector<std::string>{"turned 1 wrongly wound face"});
  for (std::size_t f = 0; f < 3; ++f) EXPECT_GT(FaceCross(result.mesh, f).z(), 0.0);
  EXPECT_EQ(result.refusal, "open: 5 boundary edges");
}

}  // namespace
}  // namespace antigrasp
