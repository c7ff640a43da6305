// glTF in one binary file: read by our own reader here, by three.js and the validator in
// report/viewer/tests.
#include "antigrasp/export/glb.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "antigrasp/export/print_files.h"
#include "antigrasp/mesh/mass_properties.h"
#include "antigrasp/mesh/mesh_file.h"
#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

using Eigen::Vector3f;

struct Parts {
  std::string json;
  std::vector<Vector3f> positions, normals;
};

Parts PartsOf(const std::string& bytes) {
  const auto word = [&](std::size_t at) {
    std::uint32_t value = 0;
    std::memcpy(&value, bytes.data() + at, sizeof value);
    return std::size_t{value};
  };
  EXPECT_EQ(word(8), bytes.size());
  Parts parts;
  parts.json = bytes.substr(20, word(12));
  const std::size_t at = parts.json.find("\"count\":") + 8;
  const std::size_t count = std::stoul(parts.json.substr(at));
  parts.positions.resize(count);
  parts.normals.resize(count);
  const char* const data = bytes.data() + 20 + word(12) + 8;
  for (std::size_t i = 0; i < 2 * count; ++i) {
    Vector3f& v = i < count ? parts.positions[i] : parts.normals[i - count];
    std::memcpy(v.data(), data + 3 * sizeof(float) * i, 3 * sizeof(float));
  }
  return parts;
}

TEST(Glb, ABoxHasThreeNormalsACornerAndABallOne) {
  const Parts box = PartsOf(GlbBytes(shapes::Box({40.0, 45.0, 60.0}), "box", kCreaseOfGlb));
  EXPECT_EQ(box.positions.size(), 24U);
  for (std::size_t i = 0; i < box.positions.size(); ++i) {
    EXPECT_EQ(box.normals[i].cwiseAbs().maxCoeff(), 1.0F);
    EXPECT_GT(box.normals[i].dot(box.positions[i]), 0.0F);
  }
  const TriangleMesh sphere = shapes::Sphere(30.0, 3);
  const Parts ball = PartsOf(GlbBytes(sphere, "ball", kCreaseOfGlb));
  EXPECT_EQ(ball.positions.size(), sphere.vertices.size());
  for (std::size_t i = 0; i < ball.positions.size(); ++i) {
    EXPECT_GT(ball.normals[i].dot(ball.positions[i].normalized()), 0.999F);
  }
  EXPECT_EQ(PartsOf(GlbBytes(sphere, "ball", 0.0)).positions.size(), 3 * sphere.faces.size());
}

// 40 x 45 x 60 mm, z up: y is 60 mm high, and z goes the other way than y did.
TEST(Glb, IsInMetresWithYUpAndTheOutsideOutside) {
  const shapes::TempFolder folder;
  PrintFiles files(folder.path(), "glb");
  const TriangleMesh box = Transformed(shapes::Box({40.0, 45.0, 60.0}), 1.0, {0.0, 100.0, 30.0});
  files.Add("box", "box.glb", box);
  files.Close();
  const MeshFile read = ReadMeshFile(folder / "box.glb");
  EXPECT_EQ(read.mesh.vertices.size(), 8U);
  EXPECT_TRUE(Bounds(read.mesh).min.isApprox(Eigen::Vector3d(-0.02, 0.0, -0.1225), 1e-6));
  EXPECT_TRUE(Bounds(read.mesh).max.isApprox(Eigen::Vector3d(0.02, 0.06, -0.0775), 1e-6));
  EXPECT_NEAR(ComputeMassProperties(read.mesh).volume, 0.04 * 0.045 * 0.06, 1e-10);
}

TEST(Glb, TheSameSolidIsTheSameBytes) {
  const TriangleMesh torus = shapes::Torus(20.0, 8.0, 24, 12);
  EXPECT_EQ(GlbBytes(torus, "a \"b\"", 0.5), GlbBytes(torus, "a \"b\"", 0.5));
}

}  // namespace
}  // namespace antigrasp
