#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <string>

#include "antigrasp/core/error.h"
#include "antigrasp/mesh/mesh_file.h"
#include "antigrasp/mesh/text_scanner.h"
#include "tests/support/temp_folder.h"

// Literal files with a lopsided triangle in each: axes, corners and index bases told apart.
namespace antigrasp {
namespace {

using shapes::TempFolder;
using Face = std::array<std::int32_t, 3>;
using Eigen::Vector3d;

TriangleMesh Read(const std::string& name, const std::string& bytes) {
  const TempFolder folder;
  return ReadMesh(folder.Write(name, bytes));
}

template <typename T>
std::string Raw(std::initializer_list<T> values) {
  std::string bytes;
  for (const T value : values) bytes.append(reinterpret_cast<const char*>(&value), sizeof(T));
  return bytes;
}

const std::vector<Vector3d> kCorners{{1, 2, 3}, {-4, 5, 6}, {7, 8, -9.5}};

void ExpectTheTriangle(const TriangleMesh& mesh) {
  EXPECT_EQ(mesh.vertices, kCorners);
  EXPECT_EQ(mesh.faces, (std::vector<Face>{{0, 1, 2}}));
}

TEST(ReadMesh, EveryFormatGivesTheSameTriangle) {
  ExpectTheTriangle(Read("a.obj", "v 1 2 3\nv -4 5 6\nv 7 8 -9.5\nf 1 2 3\n"));
  ExpectTheTriangle(Read("a.obj", "v 1 2 3\nv -4 5 6\nv 7 8 -9.5\nfo 1 2 3\n"));  // of old
  ExpectTheTriangle(Read("a.off", "OFF\n3 1 0\n1 2 3\n-4 5 6\n7 8 -9.5\n3 0 1 2\n"));
  ExpectTheTriangle(Read("a.stl",
                         "solid\nfacet normal 0 0 1\nouter loop\nvertex 1 2 3\nvertex -4 5 6\n"
                         "vertex 7 8 -9.5\nendloop\nendfacet\nendsolid\n"));
  // The normal points the wrong way: the corners are believed.
  ExpectTheTriangle(Read("a.stl", std::string(80, 'h') + Raw<std::uint32_t>({1}) +
                                      Raw<float>({0, 0, -1, 1, 2, 3, -4, 5, 6, 7, 8, -9.5F}) +
                                      "ab"));
}

TEST(ReadMesh, PlyCoordinatesGoByNameAndIndicesFromZero) {
  const std::string faces = "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  ExpectTheTriangle(Read("a.ply",
                         "ply\nformat ascii 1.0\nelement vertex 3\nproperty float z\n"
                         "property float x\nproperty float y\n" +
                             faces + "3 1 2\n6 -4 5\n-9.5 7 8\n3 0 1 2\n"));
  // Faces may come before their vertices.
  ExpectTheTriangle(Read("a.ply",
                         "ply\nformat ascii 1.0\nelement face 1\n"
                         "property list uchar int vertex_indices\nelement vertex 3\n"
                         "property float x\nproperty float y\nproperty float z\nend_header\n"
                         "3 0 1 2\n1 2 3\n-4 5 6\n7 8 -9.5\n"));
}

// z of the third vertex as each of the types, little and big endian, with a value that only this
// type holds: 200 is no int8, -3 no unsigned one.
TEST(ReadMesh, PlyKnowsEveryTypeByBothNames) {
  struct Case {
    std::array<const char*, 2> names;
    std::string bytes;
    double value;
  };
  const std::vector<Case> cases{{{"char", "int8"}, Raw<std::int8_t>({-3}), -3},
                                {{"uchar", "uint8"}, Raw<std::uint8_t>({200}), 200},
                                {{"short", "int16"}, Raw<std::int16_t>({-300}), -300},
                                {{"ushort", "uint16"}, Raw<std::uint16_t>({40000}), 40000},
                                {{"int", "int32"}, Raw<std::int32_t>({-70000}), -70000},
                                {{"uint", "uint32"}, Raw<std::uint32_t>({3000000000U}), 3e9},
                                {{"float", "float32"}, Raw<float>({-0.375F}), -0.375},
                                {{"double", "float64"}, Raw<double>({1.0 / 3}), 1.0 / 3}};
  const auto zero = [](std::size_t size) { return std::string(size, '\0'); };
  for (const Case& c : cases) {
    for (const char* name : c.names) {
      for (const bool big : {false, true}) {
        const std::string swapped(c.bytes.rbegin(), c.bytes.rend());
        const std::size_t size = c.bytes.size();
        const TriangleMesh mesh =
            Read("a.ply", "ply\nformat binary_" + std::string(big ? "big" : "little") +
                              "_endian 1.0\nelement vertex 3\nproperty char x\nproperty char y\n"
                              "property " +
                              name +
                              " z\nelement face 1\n"
                              "property list uchar char vertex_index\nend_header\n" +
                              zero(2 + size) + "\1" + zero(1 + size) + zero(1) + "\1" +
                              (big ? swapped : c.bytes) + std::string("\3\0\1\2", 4));
        ASSERT_EQ(mesh.vertices.size(), 3u) << name;
        EXPECT_EQ(mesh.vertices[1], Vector3d(1, 0, 0)) << name;
        EXPECT_EQ(mesh.vertices[2], Vector3d(0, 1, c.value)) << name;
      }
    }
  }
}

TEST(ReadMesh, VerticesKeepTheOrderOfTheFileWithoutRepeats) {
  const TriangleMesh mesh = Read("a.obj",
                                 "v 5 0 0\nv 1 2 3\nv 5 0 0\nv 0 0 7\nv 1 2 3\nv 0 9 0\n"
                                 "f 3 2 4\nf -2 -1 -3\n");
  EXPECT_EQ(mesh.vertices, (std::vector<Vector3d>{{5, 0, 0}, {1, 2, 3}, {0, 0, 7}, {0, 9, 0}}));
  EXPECT_EQ(mesh.faces, (std::vector<Face>{{0, 1, 2}, {1, 3, 2}}));
}

// A binary STL of this triangle with `count` in its header and `faces` behind it.
std::string Stl(const std::string& header, std::uint32_t count, int faces) {
  std::string bytes = header + std::string(80 - header.size(), ' ') + Raw<std::uint32_t>({count});
  for (int i = 0; i < faces; ++i) {
    bytes += Raw<float>({0, 0, 1, 1, 2, 3, -4, 5, 6, 7, 8, -9.5F + static_cast<float>(i)}) + "ab";
  }
  return bytes;
}

TEST(ReadMesh, AStlThatNeverGotItsCountIsReadByItsSize) {
  const TempFolder folder;
  for (const char* header : {"by a scanner", "solid by a scanner"}) {
    std::vector<std::string> notes;
    ExpectTheTriangle(ReadMesh(folder.Write("a.stl", Stl(header, 0, 1)), &notes));
    EXPECT_EQ(notes, (std::vector<std::string>{"the file counts 0 faces: 1 read by its size"}));
    EXPECT_EQ(ReadMesh(folder.Write("b.stl", Stl(header, 0, 3)), &notes).faces.size(), 3u);
    ExpectTheTriangle(ReadMesh(folder.Write("c.stl", Stl(header, 1, 1) + "appended"), &notes));
    EXPECT_TRUE(notes.empty());
  }
}

TEST(ReadMesh, FacesOfFewerThanThreeCornersAreLeftOutWithANote) {
  const TempFolder folder;
  const std::string three = "v 1 2 3\nv -4 5 6\nv 7 8 -9.5\n";
  const auto notes_of = [&](const std::string& name, const std::string& bytes) {
    std::vector<std::string> notes = {"of before"};
    ExpectTheTriangle(ReadMesh(folder.Write(name, bytes), &notes));
    return notes;
  };
  using Notes = std::vector<std::string>;
  EXPECT_EQ(notes_of("a.obj", three + "f 1 2 3\n"), Notes{});
  EXPECT_EQ(notes_of("a.obj", three + "f 1 2 3\nf 1 2\n"),
            Notes{"1 face of fewer than 3 corners left out (face 2 has 2 corners)"});
  EXPECT_EQ(notes_of("a.obj", three + "f 3\nf\nf 1 2 3\n"),
            Notes{"2 faces of fewer than 3 corners left out (face 1 has 1 corners)"});
  EXPECT_EQ(notes_of("a.off", "OFF\n3 2 0\n1 2 3\n-4 5 6\n7 8 -9.5\n2 0 1\n3 0 1 2\n"),
            Notes{"1 face of fewer than 3 corners left out (face 1 has 2 corners)"});
  EXPECT_THROW(Read("a.obj", three + "f 1 2\nf 2 3\n"), InputError);
  EXPECT_THROW(Read("a.obj", three + "f 1 2 3\nf 1 4\n"), InputError);  // no such vertex
}

// A tetrahedron: its corner at the origin, the others on the axes.
const std::string kTetrahedron =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
    "property float z\nelement tristrips 1\nproperty list int int vertex_indices\nend_header\n"
    "0 0 0\n1 0 0\n0 1 0\n0 0 1\n";

TEST(ReadMesh, StripsOfAPlyTurnEverySecondTriangleRound) {
  const std::vector<Face> outward{{0, 2, 1}, {1, 2, 3}, {1, 3, 0}, {0, 3, 2}};
  // 021, 213 turned, 130, 302 turned: one strip; two with -1 between; two of the triangles, joined
  // by three without area.
  EXPECT_EQ(Read("a.ply", kTetrahedron + "6 0 2 1 3 0 2\n").faces, outward);
  EXPECT_EQ(Read("a.ply", kTetrahedron + "9 0 2 1 3 -1 1 3 0 2\n").faces, outward);
  EXPECT_EQ(Read("a.ply", kTetrahedron + "7 0 2 1 1 1 3 0\n").faces,
            (std::vector<Face>{{0, 2, 1}, {1, 3, 0}}));
}

TEST(ReadMesh, APolygonHasAtMost4096Corners) {
  std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf";
  for (int i = 0; i < 4097; ++i) text += " 1";
  try {
    Read("a.obj", text + "\n");
    FAIL() << "nothing thrown";
  } catch (const InputError& error) {
    const std::string message = error.what();
    EXPECT_TRUE(message.starts_with("face 1 has 4097 corners (")) << message;
    EXPECT_TRUE(message.ends_with("a.obj): expected 3 to 4096")) << message;
  }
}

// A rhombus six long and two wide: the short diagonal, and the winding of the file.
TEST(ReadMesh, AFlatQuadIsCutAcrossItsShortDiagonal) {
  const TriangleMesh mesh = Read("a.off", "OFF\n4 1 0\n0 0 0\n3 -1 0\n6 0 0\n3 1 0\n4 0 1 2 3\n");
  EXPECT_EQ(mesh.faces, (std::vector<Face>{{3, 0, 1}, {3, 1, 2}}));
  for (std::size_t f = 0; f < 2; ++f) EXPECT_EQ(FaceCross(mesh, f), Vector3d(0, 0, 6));
}

TEST(TextScanner, CountsLinesWhateverTheirEnd) {
  for (const char* text : {"a b\n\nc\nd", "a b\r\n\r\nc\r\nd", "a b\r\rc\rd"}) {
    TextScanner scanner(text, "x");
    EXPECT_EQ(scanner.NextWord(), "a");
    EXPECT_EQ(scanner.NextWord(), "b");
    EXPECT_EQ(scanner.Where(), "x:1");
    EXPECT_EQ(scanner.NextLine(), "");
    EXPECT_EQ(scanner.NextWord(), "c");
    EXPECT_EQ(scanner.Where(), "x:3");
    EXPECT_EQ(scanner.NextWord(), "d");
    EXPECT_EQ(scanner.Where(), "x:4");
    EXPECT_FALSE(scanner.NextWord().has_value());
    EXPECT_FALSE(scanner.NextLine().has_value());
  }
}

TEST(TextScanner, NumbersAreWholeWords) {
  EXPECT_EQ(ParseNumber("+1.5"), 1.5);
  EXPECT_EQ(ParseNumber("-2E-1"), -0.2);
  EXPECT_EQ(ParseNumber("1e-999"), 0.0);
  EXPECT_EQ(ParseNumber("1e999"), std::numeric_limits<double>::infinity());
  EXPECT_EQ(ParseInteger("+7"), 7);
  EXPECT_EQ(ParseInteger("-9223372036854775808"), std::numeric_limits<std::int64_t>::min());
  for (const char* word : {"", "+", "+-1", "1x", "0x1", "--1"}) {
    EXPECT_FALSE(ParseNumber(word).has_value()) << word;
    EXPECT_FALSE(ParseInteger(word).has_value()) << word;
  }
  for (const char* word : {"1.0", "9223372036854775808"}) EXPECT_FALSE(ParseInteger(word)) << word;
}

TEST(TextScanner, MessagesQuoteFortyPrintableCharacters) {
  EXPECT_EQ(Quoted("a\tb\x7F\xFF~ "), "'a?b??~ '");
  EXPECT_EQ(Quoted(std::string(40, 'x')), "'" + std::string(40, 'x') + "'");
  EXPECT_EQ(Quoted(std::string(41, 'x')), "'" + std::string(40, 'x') + "...'");
}

}  // namespace
}  // namespace antigrasp
