#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <limits>
#include <stdexcept>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/mesh/mesh_file.h"
#include "tests/support/temp_folder.h"

// What a writer and its reader have wrong together no round trip shows: literal bytes here.
namespace antigrasp {
namespace {

using shapes::TempFolder;

std::string Written(const std::string& name, const TriangleMesh& mesh, double scale = 1.0) {
  const TempFolder folder;
  WriteMesh(folder / name, mesh, scale);
  return ReadFile(folder / name);
}

template <typename T>
std::vector<T> Values(const std::string& bytes, std::size_t at, std::size_t count) {
  std::vector<T> values(count);
  if (at + count * sizeof(T) > bytes.size()) return {};
  std::memcpy(values.data(), bytes.data() + at, count * sizeof(T));
  return values;
}

// Two triangles with every coordinate another number; the second one faces +x.
TriangleMesh Pair() {
  return {{{0.5, -1.25, 2}, {4, 0, 2}, {0.5, 8, 2}, {0.5, -1.25, 3}}, {{{0, 1, 2}, {2, 3, 0}}}};
}

TEST(WriteMesh, ObjCountsFromOne) {
  EXPECT_EQ(Written("a.obj", Pair()),
            "# written by antigrasp\n"
            "v 0.5 -1.25 2\nv 4 0 2\nv 0.5 8 2\nv 0.5 -1.25 3\n"
            "f 1 2 3\nf 3 4 1\n");
}

TEST(WriteMesh, OffCountsFromZero) {
  EXPECT_EQ(Written("a.off", Pair()),
            "OFF\n4 2 0\n"
            "0.5 -1.25 2\n4 0 2\n0.5 8 2\n0.5 -1.25 3\n"
            "3 0 1 2\n3 2 3 0\n");
}

TEST(WriteMesh, PlyIsLittleEndianDoublesAndCountedCorners) {
  const std::string head =
      "ply\nformat binary_little_endian 1.0\ncomment written by antigrasp\nelement vertex 4\n"
      "property double x\nproperty double y\nproperty double z\nelement face 2\n"
      "property list uchar int vertex_indices\nend_header\n";
  const std::string bytes = Written("a.ply", Pair());
  ASSERT_EQ(bytes.size(), head.size() + 4 * 24 + 2 * 13);
  EXPECT_EQ(bytes.substr(0, head.size()), head);
  EXPECT_EQ(bytes.substr(head.size(), 16),
            std::string("\0\0\0\0\0\0\xE0\x3F\0\0\0\0\0\0\xF4\xBF", 16));  // 0.5 and -1.25
  EXPECT_EQ(Values<double>(bytes, head.size(), 12),
            (std::vector<double>{0.5, -1.25, 2, 4, 0, 2, 0.5, 8, 2, 0.5, -1.25, 3}));
  EXPECT_EQ(bytes.substr(head.size() + 96),
            std::string("\3\0\0\0\0\1\0\0\0\2\0\0\0\3\2\0\0\0\3\0\0\0\0\0\0\0", 26));
}

TEST(WriteMesh, StlIsAHeaderAndFiftyBytesAFace) {
  const std::string bytes = Written("a.stl", Pair());
  ASSERT_EQ(bytes.size(), 184u);
  EXPECT_EQ(bytes.substr(0, 80), "binary STL written by antigrasp" + std::string(49, '\0'));
  EXPECT_EQ(bytes.substr(80, 4), std::string("\2\0\0\0", 4));
  // Unit normal, then the corners in the order of the face, then two bytes of nothing.
  EXPECT_EQ(Values<float>(bytes, 84, 12),
            (std::vector<float>{0, 0, 1, 0.5F, -1.25F, 2, 4, 0, 2, 0.5F, 8, 2}));
  EXPECT_EQ(bytes.substr(132, 2), std::string(2, '\0'));
  EXPECT_EQ(Values<float>(bytes, 134, 12),
            (std::vector<float>{1, 0, 0, 0.5F, 8, 2, 0.5F, -1.25F, 3, 0.5F, -1.25F, 2}));
  EXPECT_EQ(bytes.substr(182), std::string(2, '\0'));
}

// Counter-clockwise seen from where the normal points: (1, 0, 0) x (0, 1, 0) = (0, 0, 1).
TEST(WriteMesh, AnStlNormalPointsToTheSideItsFaceIsCounterClockwiseFrom) {
  const TriangleMesh flat{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{{0, 1, 2}}}};
  EXPECT_EQ(Written("a.stl", flat).substr(84, 12), std::string("\0\0\0\0\0\0\0\0\0\0\x80\x3F", 12));
  const TriangleMesh below{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{{0, 2, 1}}}};
  EXPECT_EQ(Values<float>(Written("a.stl", below), 84, 3), (std::vector<float>{0, 0, -1}));
  // 3 e_x x 4 e_z = -12 e_y; and a slope: (2, 0, 0) x (0, 4, 3) = (0, -6, 8), length 10.
  const TriangleMesh upright{{{0, 0, 0}, {3, 0, 0}, {0, 0, 4}}, {{{0, 1, 2}}}};
  EXPECT_EQ(Values<float>(Written("a.stl", upright), 84, 3), (std::vector<float>{0, -1, 0}));
  const TriangleMesh slope{{{0, 0, 0}, {2, 0, 0}, {0, 4, 3}}, {{{0, 1, 2}}}};
  EXPECT_EQ(Values<float>(Written("a.stl", slope), 84, 3), (std::vector<float>{0, -0.6F, 0.8F}));
}

TEST(WriteMesh, AnStlNormalIsThatOfTheStoredCorners) {
  // 1 + 1e-9 is stored as 1: the normal is exactly e_x, and zero where no area is left.
  const TriangleMesh rounded{{{1, 0, 0}, {1 + 1e-9, 1, 0}, {1, 0, 1}}, {{{0, 1, 2}, {0, 1, 1}}}};
  const std::string bytes = Written("a.stl", rounded);
  EXPECT_EQ(Values<float>(bytes, 84, 6), (std::vector<float>{1, 0, 0, 1, 0, 0}));
  EXPECT_EQ(Values<float>(bytes, 134, 3), (std::vector<float>{0, 0, 0}));
}

TEST(WriteMesh, StlHasNoNegativeZeros) {
  const TriangleMesh mesh{{{-0.0, 0, -0.0}, {1, -0.0, 0}, {0, 1, 0}}, {{{0, 1, 2}}}};
  const TriangleMesh plain{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{{0, 1, 2}}}};
  EXPECT_EQ(Written("a.stl", mesh), Written("a.stl", plain));
}

TEST(WriteMesh, ScaleTurnsMetresToMillimetresInEveryFormat) {
  const TriangleMesh metres{{{0.001, 0.002, 0.003}, {0.01, 0, 0}, {0, 0.02, 0}}, {{{0, 1, 2}}}};
  EXPECT_EQ(Written("a.obj", metres, 1000.0),
            "# written by antigrasp\nv 1 2 3\nv 10 0 0\nv 0 20 0\nf 1 2 3\n");
  EXPECT_EQ(Written("a.off", metres, 1000.0), "OFF\n3 1 0\n1 2 3\n10 0 0\n0 20 0\n3 0 1 2\n");
  EXPECT_EQ(Values<float>(Written("a.stl", metres, 1000.0), 96, 6),
            (std::vector<float>{1, 2, 3, 10, 0, 0}));
  const std::string ply = Written("a.ply", metres, 1000.0);
  EXPECT_EQ(Values<double>(ply, ply.size() - 13 - 72, 6), (std::vector<double>{1, 2, 3, 10, 0, 0}));
}

TEST(WriteMesh, RefusesWhatIsNotFiniteAfterScaling) {
  const TempFolder folder;
  TriangleMesh mesh = Pair();
  EXPECT_THROW(WriteMesh(folder / "a.off", mesh, std::numeric_limits<double>::infinity()),
               std::logic_error);
  mesh.faces[1][2] = 4;  // one behind the last
  EXPECT_THROW(WriteMesh(folder / "a.off", mesh), std::logic_error);
  mesh.faces[1][2] = -1;
  EXPECT_THROW(WriteMesh(folder / "a.off", mesh), std::logic_error);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace
}  // namespace antigrasp
