#include "antigrasp/report/page/display_mesh.h"

#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <limits>
#include <set>

#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;

constexpr std::size_t kAll = 1'000'000;

const unsigned char* Bytes(const std::string& text) {
  return reinterpret_cast<const unsigned char*>(text.data());
}

// What the page's decoder makes of the two streams.
TriangleMesh Decoded(const DisplayMesh& display) {
  const std::string positions = EncodePositions(display), indices = EncodeIndices(display);
  std::vector<std::array<std::uint16_t, 4>> quantised(display.vertices.size());
  EXPECT_EQ(meshopt_decodeVertexBuffer(quantised.data(), quantised.size(), 8, Bytes(positions),
                                       positions.size()),
            0);
  std::vector<std::uint32_t> corners(display.indices.size());
  EXPECT_EQ(
      meshopt_decodeIndexBuffer(corners.data(), corners.size(), 4, Bytes(indices), indices.size()),
      0);
  TriangleMesh mesh;
  for (const auto& q : quantised) {
    EXPECT_EQ(q[3], 0);
    mesh.vertices.push_back(display.min + Vector3d(q[0], q[1], q[2]) / 65535.0 * display.extent);
  }
  for (std::size_t i = 0; i < corners.size(); i += 3) {
    mesh.faces.push_back({static_cast<int>(corners[i]), static_cast<int>(corners[i + 1]),
                          static_cast<int>(corners[i + 2])});
  }
  return mesh;
}

// The triangles as coordinates rounded to `step`, each begun at its smallest corner: the winding
// counts, the order does not.
using Corner = std::array<long, 3>;
std::multiset<std::array<Corner, 3>> Triangles(const TriangleMesh& mesh, double step) {
  std::multiset<std::array<Corner, 3>> triangles;
  for (const auto& face : mesh.faces) {
    std::array<Corner, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector3d& v = mesh.vertices[static_cast<std::size_t>(face[k])];
      for (int axis = 0; axis < 3; ++axis) {
        corners[k][static_cast<std::size_t>(axis)] = std::lround(v[axis] / step);
      }
    }
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    triangles.insert(corners);
  }
  return triangles;
}

TEST(DisplayMesh, DecodesToEveryTriangleWithinHalfAStepOfSixteenBits) {
  for (const TriangleMesh& mesh :
       {shapes::Box({1.0, 2.0, 0.25}), shapes::FlatSquare(),
        Transformed(shapes::Torus(2.0, 0.5, 24, 12), 1e-3, {700.0, -3.0, 0.0}),
        Transformed(shapes::Cube(), 1e6, {0.0, 0.0, 0.0})}) {
    const auto display = MakeDisplayMesh(mesh, kAll);
    ASSERT_TRUE(display);
    EXPECT_EQ(display->vertices.size(), mesh.vertices.size());
    EXPECT_EQ(display->full_triangles, mesh.faces.size());
    EXPECT_EQ(display->extent, Bounds(mesh).Extent().maxCoeff());
    const TriangleMesh decoded = Decoded(*display);
    ASSERT_EQ(decoded.vertices.size(), display->vertices.size());
    const double half_step = 0.5 * display->extent / 65535.0;
    for (std::size_t v = 0; v < decoded.vertices.size(); ++v) {
      EXPECT_LE((decoded.vertices[v] - display->vertices[v]).cwiseAbs().maxCoeff(),
                half_step * (1.0 + 1e-6));
    }
    const double coarse = display->extent / 1000.0;
    EXPECT_EQ(Triangles(decoded, coarse), Triangles(mesh, coarse));
  }
}

TEST(DisplayMesh, IsNoneForWhatCannotBeDrawn) {
  const double nan = std::nan(""), inf = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(MakeDisplayMesh({}, kAll));
  TriangleMesh mesh = shapes::Cube();
  mesh.faces.clear();
  EXPECT_FALSE(MakeDisplayMesh(mesh, kAll));
  for (const double bad : {nan, inf, -inf, 1e300, 1e20}) {
    mesh = shapes::Cube();
    mesh.vertices[3].y() = bad;
    EXPECT_FALSE(MakeDisplayMesh(mesh, kAll)) << bad;
  }
  for (const int bad : {-1, 8, std::numeric_limits<int>::max()}) {
    mesh = shapes::Cube();
    mesh.faces[5][1] = bad;
    EXPECT_FALSE(MakeDisplayMesh(mesh, kAll)) << bad;
  }
  mesh = {{{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}, {{0, 1, 2}}};
  EXPECT_FALSE(MakeDisplayMesh(mesh, kAll));  // no extent
  mesh.faces = {{0, 0, 1}};
  EXPECT_FALSE(MakeDisplayMesh(mesh, kAll));  // no triangle
}

TEST(DisplayMesh, DrawsABrokenMeshAndLeavesOutWhatNoFaceUses) {
  TriangleMesh mesh = shapes::FlatSquare();
  mesh.vertices.push_back({100.0, 100.0, 100.0});
  mesh.faces.push_back({0, 0, 2});
  mesh.faces.push_back(mesh.faces[0]);  // twice
  const auto display = MakeDisplayMesh(mesh, kAll);
  ASSERT_TRUE(display);
  EXPECT_EQ(display->vertices.size(), 4u);
  EXPECT_EQ(display->extent, 1.0);
  EXPECT_EQ(Decoded(*display).faces.size(), 3u);
}

TEST(DisplayMesh, OfALargeMeshIsSimplifiedCloseToItsSurface) {
  const TriangleMesh sphere = shapes::Sphere(1.0, 5);  // 20,480 faces
  const auto display = MakeDisplayMesh(sphere, 2000);
  ASSERT_TRUE(display);
  EXPECT_EQ(display->full_triangles, 20480u);
  EXPECT_LE(display->indices.size(), 3 * 2000u);
  EXPECT_GT(display->indices.size(), 3 * 1500u);
  const TriangleMesh decoded = Decoded(*display);
  for (const Vector3d& vertex : decoded.vertices) EXPECT_NEAR(vertex.norm(), 1.0, 1e-4);
  EXPECT_NEAR(Volume(decoded), Volume(sphere), 0.01 * Volume(sphere));
  EXPECT_EQ(MakeDisplayMesh(sphere, 20480)->indices.size(), 3 * 20480u);
}

TEST(DisplayMesh, OfManyLoosePiecesIsClusteredDown) {
  TriangleMesh crumbs;
  for (int i = 0; i < 4000; ++i) {
    const Vector3d at(i % 20, i / 20 % 20, i / 400);
    const int first = static_cast<int>(crumbs.vertices.size());
    crumbs.vertices.insert(crumbs.vertices.end(),
                           {at, at + 0.3 * Vector3d::UnitX(), at + 0.3 * Vector3d::UnitY()});
    crumbs.faces.push_back({first, first + 1, first + 2});
  }
  const auto display = MakeDisplayMesh(crumbs, 500);
  ASSERT_TRUE(display);
  EXPECT_LE(display->indices.size(), 2 * 3 * 500u);
  EXPECT_EQ(display->full_triangles, 4000u);
}

}  // namespace
}  // namespace antigrasp
