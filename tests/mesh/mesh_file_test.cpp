#include "antigrasp/mesh/mesh_file.h"
#include "antigrasp/mesh/mesh_format.h"

#include <gtest/gtest.h>

#include <cstring>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/error.h"
#include "antigrasp/mesh/inspect.h"
#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

using shapes::TempFolder;

class MeshFormats : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(All, MeshFormats, testing::Values("stl", "obj", "ply", "off"));

TEST_P(MeshFormats, WhatIsWrittenReadsBackAsTheSameSolid) {
  const TempFolder folder;
  const auto path = folder / (std::string("shape.") + GetParam());
  for (const TriangleMesh& mesh : {shapes::Sphere(0.37, 3), shapes::Torus(1.0, 0.3, 24, 12),
                                   shapes::Box({1e-3, 2e-3, 3e-3})}) {
    WriteMesh(path, mesh);
    const TriangleMesh read = ReadMesh(path);
    const MeshReport before = Inspect(mesh), after = Inspect(read);
    EXPECT_TRUE(after.IsSolid()) << WhyNotSolid(after);
    EXPECT_EQ(read.vertices.size(), mesh.vertices.size());
    EXPECT_EQ(read.faces.size(), mesh.faces.size());
    EXPECT_EQ(after.genus, before.genus);
    EXPECT_NEAR(after.volume, before.volume, 1e-6 * before.volume);  // STL is float32
  }
}

TEST_P(MeshFormats, TheSameMeshGivesTheSameBytes) {
  const TempFolder folder;
  const std::string extension = GetParam();
  const TriangleMesh mesh = shapes::Sphere(0.5, 2);
  WriteMesh(folder / ("a." + extension), mesh);
  WriteMesh(folder / ("b." + extension), mesh);
  EXPECT_EQ(ReadFile(folder / ("a." + extension)), ReadFile(folder / ("b." + extension)));
}

TEST_P(MeshFormats, ScaleMultipliesTheCoordinates) {
  const TempFolder folder;
  const auto path = folder / (std::string("mm.") + GetParam());
  WriteMesh(path, shapes::Box({0.01, 0.02, 0.03}), 1000.0);
  EXPECT_TRUE(Bounds(ReadMesh(path)).Extent().isApprox(Eigen::Vector3d(10, 20, 30), 1e-6));
}

TEST_P(MeshFormats, EveryTruncationIsAnInputErrorOrAShorterMesh) {
  const TempFolder folder;
  const std::string extension = GetParam();
  WriteMesh(folder / ("whole." + extension), shapes::Tetrahedron());
  const std::string bytes = ReadFile(folder / ("whole." + extension));
  int refused = 0;
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    const auto path = folder.Write("cut." + extension, bytes.substr(0, size));
    try {
      EXPECT_LE(ReadMesh(path).faces.size(), 4u);
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(path.string()), std::string::npos) << error.what();
      ++refused;
    }
  }
  EXPECT_GT(refused, static_cast<int>(bytes.size()) / 2);
}

TEST(MeshFile, TextAndPlyFormatsKeepEveryBitOfACoordinate) {
  const TempFolder folder;
  const TriangleMesh sphere = shapes::Sphere(1.0 / 3.0, 2);
  for (const char* name : {"a.obj", "a.ply", "a.off"}) {
    WriteMesh(folder / name, sphere);
    const TriangleMesh read = ReadMesh(folder / name);
    EXPECT_EQ(read.vertices, sphere.vertices);
    EXPECT_EQ(read.faces, sphere.faces);
  }
}

TEST(MeshFile, BinaryStlDoesNotLookLikeAscii) {
  const TempFolder folder;
  WriteMesh(folder / "a.stl", shapes::Tetrahedron());
  const std::string bytes = ReadFile(folder / "a.stl");
  EXPECT_EQ(bytes.size(), 84u + 4u * 50u);
  EXPECT_FALSE(bytes.starts_with("solid"));
}

TEST(MeshFile, KnowsExtensionsInAnyCase) {
  for (const char* name : {"a.stl", "b.STL", "c.Obj", "d.pLy", "e.off"}) {
    EXPECT_TRUE(IsMeshFile(name)) << name;
  }
  for (const char* name : {"a.step", "stl", ".stl", "b.stl.gz", ""}) {
    EXPECT_FALSE(IsMeshFile(name)) << name;
  }
  EXPECT_THROW(WriteMesh("/nowhere/a.step", shapes::Cube()), InputError);
  EXPECT_THROW(WriteMesh("/nowhere/a.stl", shapes::Cube()), InputError);
}

TEST(MeshFile, EveryListedFormatIsReadAndWritten) {
  const TempFolder folder;
  for (const std::string& extension : WritableExtensions()) {
    WriteMesh(folder / ("a." + extension), shapes::Tetrahedron());
    EXPECT_TRUE(std::filesystem::exists(folder / ("a." + extension))) << extension;
  }
  for (const std::string& extension : WritableExtensions()) {
    EXPECT_EQ(ReadMesh(folder / ("a." + extension)).faces.size(), 4u) << extension;
  }
  EXPECT_EQ(WritableExtensions(), (std::vector<std::string>{"stl", "obj", "ply", "off"}));
  EXPECT_EQ(ReadableExtensions(),
            (std::vector<std::string>{"stl", "obj", "ply", "off", "3mf", "glb", "dae"}));
}

TEST(MeshFile, RefusesToWriteWhatNoReaderWouldTake) {
  const TempFolder folder;
  TriangleMesh mesh = shapes::Cube();
  mesh.faces[0][0] = 99;
  EXPECT_THROW(WriteMesh(folder / "a.stl", mesh), std::logic_error);
  EXPECT_FALSE(std::filesystem::exists(folder / "a.stl"));
}

TEST(ObjFile, GroupsMaterialsPolygonsAndNegativeIndicesComeThrough) {
  const TempFolder folder;
  const auto path = folder.Write("cube.obj",
                                 "# exported\r\nmtllib cube.mtl\r\no cube\r\n"
                                 "v 0 0 0\r\nv 1 0 0 1.0\r\nv 1 1 0 0.5 0.5 0.5\r\nv 0\t1\t0\r\n"
                                 "v 0 0 1\nv 1 0 1\nv 1 1 1\nv +0 1e0 1.\n"
                                 "vt 0 0\nvn 0 0 1\ng bottom\nusemtl red\ns off\n"
                                 "f 1/1/1 4/1/1 3/1/1 2/1/1\ng top\nf\t5//1\t6//1\t7//1\t8//1\n"
                                 "usemtl blue\nf 1/1 2/1 6/1 5/1 # front\nf 2 3 \\\n 7 6\n"
                                 "l 1 2\np 3\nweird statement\n"
                                 "f -6 -5 -1 -2\nf 4 1 5 8\n");
  const TriangleMesh mesh = ReadMesh(path);
  EXPECT_EQ(mesh.faces.size(), 12u);
  EXPECT_TRUE(Inspect(mesh).IsSolid()) << WhyNotSolid(Inspect(mesh));
  EXPECT_DOUBLE_EQ(Volume(mesh), 1.0);
}

TEST(ObjFile, VerticesMayFollowTheirFaces) {
  const TempFolder folder;
  const auto path = folder.Write("a.obj", "f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\n");
  EXPECT_EQ(ReadMesh(path).faces.size(), 1u);
}

TEST(ObjFile, VerticesDuplicatedPerFaceAreMerged) {
  const TempFolder folder;
  std::string text;
  const TriangleMesh cube = shapes::Cube();
  for (const auto& face : cube.faces) {
    for (const auto corner : face) {
      const auto& v = cube.vertices[corner];
      text += "v " + std::to_string(v.x()) + " " + std::to_string(v.y()) + " " +
              std::to_string(v.z()) + "\n";
    }
    text += "f -3 -2 -1\n";
  }
  const TriangleMesh mesh = ReadMesh(folder.Write("a.obj", text));
  EXPECT_EQ(mesh.vertices.size(), 8u);
  EXPECT_TRUE(Inspect(mesh).IsSolid());
}

constexpr const char* kAsciiFacet =
    "facet normal nan nan nan\n outer loop\n  vertex 0 0 0\n  vertex 1 0 0\n vertex\t0\n\n 1E0 -0\n"
    " endloop\nendfacet\n";

TEST(StlFile, AsciiMayHaveAnyWhitespaceCaseAndNumberOfSolids) {
  const TempFolder folder;
  const std::string solid = std::string("  solid facet vertex\n") + kAsciiFacet + "endsolid\n";
  EXPECT_EQ(ReadMesh(folder.Write("a.stl", "\r\n" + solid + solid)).faces.size(), 2u);
  std::string upper = std::string("solid\n") + kAsciiFacet + "endsolid facet";
  for (char& c : upper) c = static_cast<char>(std::toupper(c));
  EXPECT_EQ(ReadMesh(folder.Write("b.stl", upper)).faces.size(), 1u);
}

TEST(StlFile, ABinaryFileMayBeginWithSolidAndEndWithMore) {
  const TempFolder folder;
  WriteMesh(folder / "a.stl", shapes::Cube());
  std::string bytes = ReadFile(folder / "a.stl");
  std::memcpy(bytes.data(), "solid facet", 11);
  EXPECT_EQ(ReadMesh(folder.Write("b.stl", bytes)).faces.size(), 12u);
  std::memcpy(bytes.data(), "other header", 12);
  EXPECT_EQ(ReadMesh(folder.Write("c.stl", bytes + "appended")).faces.size(), 12u);
}

TEST(PlyFile, AsciiWithOtherElementsPropertiesAndWindowsLines) {
  const TempFolder folder;
  const auto path = folder.Write(
      "a.ply",
      "ply\r\nformat ascii 1.0\r\ncomment x\r\nobj_info y\r\nelement vertex 4\r\n"
      "property uchar red\r\nproperty float64 x\r\nproperty float y\r\nproperty float32 z\r\n"
      "element edge 1\r\nproperty int vertex1\r\nproperty list uchar int more\r\n"
      "element face 3\r\nproperty list uint8 int32 vertex_index\r\n"
      "property list uchar float texcoord\r\nend_header\r\n"
      "9 0 0 0\r\n9 1 0 0\r\n9 0 1 0\r\n9 0 0 1\r\n7 2 5 6\r\n"
      "3 0 2 1 0\r\n3 0 1 3 2 0.5 0.5\r\n3 0 3 2 0\r\n");
  const TriangleMesh mesh = ReadMesh(path);
  EXPECT_EQ(mesh.faces.size(), 3u);
  EXPECT_EQ(Inspect(mesh).boundary_edges, 3);
  EXPECT_EQ(mesh.vertices[3], Eigen::Vector3d(0, 0, 1));
}

template <typename T>
void AppendBig(std::string* bytes, T value) {
  const auto* raw = reinterpret_cast<const char*>(&value);
  bytes->append(std::reverse_iterator(raw + sizeof(T)), std::reverse_iterator(raw));
}

TEST(PlyFile, BigEndianBinaryReadsTheSame) {
  const TempFolder folder;
  const TriangleMesh cube = shapes::Cube();
  std::string bytes =
      "ply\nformat binary_big_endian 1.0\nelement vertex 8\nproperty float x\nproperty float y\n"
      "property float z\nproperty short label\nelement face 12\n"
      "property list ushort uint vertex_indices\nend_header\n";
  for (const auto& v : cube.vertices) {
    for (int k = 0; k < 3; ++k) AppendBig(&bytes, static_cast<float>(v[k]));
    AppendBig(&bytes, std::int16_t{-5});
  }
  for (const auto& face : cube.faces) {
    AppendBig(&bytes, std::uint16_t{3});
    for (const auto corner : face) AppendBig(&bytes, static_cast<std::uint32_t>(corner));
  }
  const TriangleMesh mesh = ReadMesh(folder.Write("a.ply", bytes));
  EXPECT_EQ(mesh.vertices, cube.vertices);
  EXPECT_EQ(mesh.faces, cube.faces);
}

TEST(OffFile, CommentsColoursAndGluedCountsComeThrough) {
  const TempFolder folder;
  const std::string body =
      "# vertices\n0 0 0\n\n1 0 0 # second\n0 1 0\n0 0 1\n3 0 2 1 255 0 0\n3 0 1 3\n3 0 3 2\n"
      "3 1 2 3\n";
  for (const std::string header : {"OFF\n4 4 6\n", "OFF # four\n# c\n4 4\n", "OFF 4 4 6\n",
                                   "OFF4 4 6\n", "COFF\n4 4 0\n", "STCNOFF\n4 4 0\n"}) {
    const TriangleMesh mesh = ReadMesh(folder.Write("a.off", header + body));
    EXPECT_TRUE(Inspect(mesh).IsSolid()) << header;
    EXPECT_DOUBLE_EQ(Volume(mesh), 1.0 / 6.0);
  }
}

TEST(FindMeshFile, TakesWhateverFormatIsThere) {
  const TempFolder folder;
  EXPECT_EQ(FindMeshFile(folder.path(), "a.b"), folder / "a.b.stl");
  WriteMesh(folder / "a.b.ply", shapes::Cube());
  EXPECT_EQ(FindMeshFile(folder.path(), "a.b"), folder / "a.b.ply");
  WriteMesh(folder / "a.b.stl", shapes::Cube());
  EXPECT_EQ(FindMeshFile(folder.path(), "a.b"), folder / "a.b.stl");
}

}  // namespace
}  // namespace antigrasp
