#include <gtest/gtest.h>

#include <cstdint>
#include <limits>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/error.h"
#include "antigrasp/core/rng.h"
#include "antigrasp/mesh/inspect.h"
#include "antigrasp/mesh/mesh_file.h"
#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

using shapes::TempFolder;

template <typename T>
std::string Raw(std::initializer_list<T> values) {
  std::string bytes;
  for (const T value : values) bytes.append(reinterpret_cast<const char*>(&value), sizeof(T));
  return bytes;
}

// The message must name the path, and neither the program nor the console may notice more.
void ExpectRefused(const std::string& name, const std::string& bytes, const std::string& part) {
  const TempFolder folder;
  const auto path = folder.Write(name, bytes);
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  std::string message = "nothing thrown";
  try {
    ReadMesh(path);
  } catch (const InputError& error) {
    message = error.what();
  }
  EXPECT_EQ(testing::internal::GetCapturedStdout() + testing::internal::GetCapturedStderr(), "");
  EXPECT_NE(message.find(path.string()), std::string::npos) << message;
  EXPECT_NE(message.find(part), std::string::npos) << message;
  EXPECT_NE(message.find("expected"), std::string::npos) << message;
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
}

TEST(HostileFile, EmptyGarbageAndForeignFilesAreRefusedInEveryFormat) {
  const std::string garbage = "hello world, this is a letter and no mesh at all\n\xff\xfe" +
                              std::string(200, '\0') + "more";
  for (const char* name : {"a.stl", "a.obj", "a.ply", "a.off", "a.3mf", "a.glb", "a.dae"}) {
    ExpectRefused(name, "", "empty file");
    ExpectRefused(name, garbage, "expected");
    ExpectRefused(name, "\n\n\n", "expected");
    ExpectRefused(name, std::string(1000, '\0'), "expected");
    ExpectRefused(name, "<html><body>404</body></html>", "expected");
  }
}

TEST(HostileFile, MissingFilesFoldersAndUnknownExtensionsAreRefused) {
  const TempFolder folder;
  EXPECT_THROW(ReadMesh(folder / "none.stl"), InputError);
  std::filesystem::create_directory(folder / "folder.stl");
  EXPECT_THROW(ReadMesh(folder / "folder.stl"), InputError);
  EXPECT_THROW(ReadMesh(folder.Write("a.step", "solid")), InputError);
}

const std::string kStlHead(80, 'x');
const std::string kStlFace = Raw<float>({0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0}) + "ab";

TEST(HostileFile, StlCountsAreCheckedAgainstTheFileSize) {
  ExpectRefused("a.stl", kStlHead + Raw<std::uint32_t>({4294967295u}) + kStlFace, "214748364834");
  ExpectRefused("a.stl", kStlHead + Raw<std::uint32_t>({2}) + kStlFace + kStlFace.substr(0, 30),
                "184 bytes");
  ExpectRefused("a.stl", kStlHead + Raw<std::uint32_t>({99}) + kStlFace + kStlFace,
                "2 faces by its 184 bytes, 99 by its face count");
  ExpectRefused("a.stl", kStlHead + Raw<std::uint32_t>({1}) + kStlFace + kStlFace,
                "wrong count: 2 faces by its 184 bytes, 1 by its face count");
  ExpectRefused("a.stl", kStlHead + Raw<std::uint32_t>({0}) + kStlFace + "x",
                "wrong count: 1 faces by its 135 bytes, 0 by its face count");
  // The name of a solid begins many binary files.
  ExpectRefused("a.stl", "solid" + kStlHead.substr(5) + Raw<std::uint32_t>({2}) + kStlFace,
                "1 faces by its 134 bytes, 2 by its face count");
  ExpectRefused("a.stl", kStlHead, "84");
  ExpectRefused("a.stl", kStlHead + Raw<std::uint32_t>({0}), "no vertices");
}

TEST(HostileFile, StlCoordinatesMustBeFinite) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  ExpectRefused("a.stl",
                kStlHead + Raw<std::uint32_t>({1}) +
                    Raw<float>({0, 0, 1, 0, nan, 0, 1, 0, 0, 0, 1, 0}) + "ab",
                "vertex 1 = 0 nan 0");
  ExpectRefused("a.stl",
                "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex inf 0 0\n"
                "vertex 0 1 0\nendloop\nendfacet\nendsolid\n",
                "inf");
}

TEST(HostileFile, AsciiStlMustFollowItsGrammarToTheEnd) {
  ExpectRefused("a.stl", "solid x\n", "endsolid");
  ExpectRefused("a.stl", "solid x\nendsolid x\n", "no vertices");
  ExpectRefused("a.stl", "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0", ":4");
  ExpectRefused("a.stl", "solid x\nfacet\nouter loop\nvertex 0 zero 0\n", "'zero'");
  ExpectRefused("a.stl", "solid x\nfacet\nouter loop\nvertex 0 0 0\nendloop\nendfacet\nendsolid",
                "1 corners");
  ExpectRefused("a.stl", "solid x\nbox 1 2 3\nendsolid", "'box'");
}

TEST(HostileFile, ObjErrorsNameTheirLine) {
  const std::string three = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  ExpectRefused("a.obj", three + "f 1 2 4\n", "vertex number 3");
  ExpectRefused("a.obj", three + "f -4 2 3\n", "vertex number -1");
  ExpectRefused("a.obj", three + "f 0 1 2\n", ".obj:4");
  ExpectRefused("a.obj", three + "f 1 2 x\n", "'x'");
  ExpectRefused("a.obj", three + "f 1 2 99999999999999999999\n", ".obj:4");
  ExpectRefused("a.obj", three + "f 1 2 9223372036854775807\n", "vertex number");
  ExpectRefused("a.obj", three + "f 1 2 -9223372036854775807\n", "vertex number");
  ExpectRefused("a.obj", three + "f 1 2\n", "2 corners");
  ExpectRefused("a.obj", three + "f\n", "0 corners");
  ExpectRefused("a.obj", three, "no faces");
  ExpectRefused("a.obj", "v 0 0\n" + three + "f 1 2 3\n", ".obj:1");
  ExpectRefused("a.obj", "v 0 nan 0\n" + three + "f 1 2 3\n", "nan");
  ExpectRefused("a.obj", "v 0 1e999 0\n" + three + "f 1 2 3\n", "inf");
  ExpectRefused("a.obj", "v 0 1e31 0\n" + three + "f 1 2 3\n", "1e30");
  std::string many = three + "f";
  for (int i = 0; i < 5000; ++i) many += " 1 2 3";
  ExpectRefused("a.obj", many + "\n", "15000 corners");
}

std::string PlyHead(const std::string& format, const std::string& vertices,
                    const std::string& faces, const std::string& list = "uchar int") {
  return "ply\nformat " + format + " 1.0\nelement vertex " + vertices +
         "\nproperty float x\nproperty float y\nproperty float z\nelement face " + faces +
         "\nproperty list " + list + " vertex_indices\nend_header\n";
}

TEST(HostileFile, AsciiPlyCountsAndIndicesAreNotBelieved) {
  const std::string points = "0 0 0\n1 0 0\n0 1 0\n";
  ExpectRefused("a.ply", PlyHead("ascii", "4000000000", "1") + points + "3 0 1 2\n", "ends");
  ExpectRefused("a.ply", PlyHead("ascii", "3", "9223372036854775807") + points + "3 0 1 2\n",
                "ends");
  ExpectRefused("a.ply", PlyHead("ascii", "-3", "1") + points + "3 0 1 2\n", "'vertex'");
  ExpectRefused("a.ply", PlyHead("ascii", "3", "1") + points + "2000000000 0 1 2\n", "ends");
  ExpectRefused("a.ply", PlyHead("ascii", "3", "1") + points + "-1 0 1 2\n", "length");
  ExpectRefused("a.ply", PlyHead("ascii", "3", "1") + points + "nan 0 1 2\n", "length");
  ExpectRefused("a.ply", PlyHead("ascii", "3", "1") + points + "3 0 1 3\n", "vertex number 3");
  ExpectRefused("a.ply", PlyHead("ascii", "3", "1") + points + "3 0 1 -1\n", "vertex number -1");
  ExpectRefused("a.ply", PlyHead("ascii", "3", "1") + points + "3 0 1 1.5\n", "vertex number -1");
  ExpectRefused("a.ply", PlyHead("ascii", "3", "1") + "0 0 nan\n1 0 0\n0 1 0\n3 0 1 2\n", "nan");
  ExpectRefused("a.ply", PlyHead("ascii", "3", "0") + points, "no faces");
}

TEST(HostileFile, BinaryPlyCountsAndLengthsAreNotBelieved) {
  const std::string points = Raw<float>({0, 0, 0, 1, 0, 0, 0, 1, 0});
  const std::string face = "\3" + Raw<std::int32_t>({0, 1, 2});
  const char* little = "binary_little_endian";
  ExpectRefused("a.ply", PlyHead(little, "4000000000", "1") + points + face, "ends");
  ExpectRefused("a.ply", PlyHead(little, "3", "4000000000") + points + face, "ends");
  ExpectRefused(
      "a.ply",
      PlyHead(little, "3", "1", "uint int") + points + Raw<std::uint32_t>({4294967280u, 0, 1, 2}),
      "ends");
  ExpectRefused("a.ply",
                PlyHead(little, "3", "1", "int int") + points + Raw<std::int32_t>({-3, 0, 1, 2}),
                "length");
  ExpectRefused("a.ply", PlyHead(little, "3", "1") + points + face.substr(0, 7), "ends");
  const std::string empty_element = "element nothing 9223372036854775807\nend_header\n";
  std::string head = PlyHead(little, "3", "1");
  head.replace(head.find("end_header\n"), 11, empty_element);
  const TempFolder folder;
  EXPECT_EQ(ReadMesh(folder.Write("a.ply", head + points + face)).faces.size(), 1u);
}

TEST(HostileFile, PlyHeadersMustDescribeAMesh) {
  ExpectRefused("a.ply", "ply\n", "header");
  ExpectRefused("a.ply", "ply\nformat ebcdic 1.0\nend_header\n", "'ebcdic'");
  ExpectRefused("a.ply", "ply\nelement vertex 3\nend_header\n", "format");
  ExpectRefused("a.ply", "ply\nformat ascii 1.0\nend_header\n", "without a mesh");
  ExpectRefused("a.ply", "ply\nformat ascii 1.0\nproperty float x\nend_header\n", ":3");
  ExpectRefused("a.ply", PlyHead("ascii", "3", "1", "float int"), "integer type");
  ExpectRefused("a.ply", PlyHead("ascii", "3", "1", "uchar quaternion"), "'quaternion'");
}

TEST(HostileFile, PlyStripsAreNotBelieved) {
  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\nelement tristrips 1\nproperty list int int vertex_indices\nend_header\n"
      "0 0 0\n1 0 0\n0 1 0\n";
  ExpectRefused("a.ply", head + "3 0 1 3\n", "vertex number 3");
  ExpectRefused("a.ply", head + "3 0 1 -2\n", "vertex number -2");
  ExpectRefused("a.ply", head + "3 0 1 1.5\n", "vertex number -2");
  ExpectRefused("a.ply", head + "2000000000 0 1 2\n", "ends");
  ExpectRefused("a.ply", head + "5 0 1 -1 1 2\n", "no faces");
  ExpectRefused("a.ply", head + "0\n", "no faces");
}

TEST(HostileFile, OffCountsAndIndicesAreNotBelieved) {
  const std::string points = "0 0 0\n1 0 0\n0 1 0\n";
  ExpectRefused("a.off", "OFF\n4000000000 1 0\n" + points, ".off:");
  ExpectRefused("a.off", "OFF\n3 4000000000 0\n" + points + "3 0 1 2\n", "4000000000 faces");
  ExpectRefused("a.off", "OFF\n-3 1 0\n" + points, "'-3'");
  ExpectRefused("a.off", "OFF\n3 1 0\n" + points + "2000000000 0 1 2\n", "''");
  ExpectRefused("a.off", "OFF\n3 1 0\n" + points + "3 0 1 3\n", "vertex number 3");
  ExpectRefused("a.off", "OFF\n3 1 0\n" + points + "3 0 1 -2\n", "'-2'");
  ExpectRefused("a.off", "OFF\n3 1 0\n0 0 nan\n1 0 0\n0 1 0\n3 0 1 2\n", "nan");
  ExpectRefused("a.off", "OFF BINARY\n" + std::string(12, '\1'), "binary OFF");
  ExpectRefused("a.off", "4OFF\n3 1 0\n", "'4OFF'");
  ExpectRefused("a.off", "OFF\n", "ends");
}

// Bytes overwritten at random: whatever comes of it is a mesh or an InputError.
TEST(HostileFile, DamagedFilesNeverDoMoreThanThrowInputError) {
  const TempFolder folder;
  for (const std::string extension : {"stl", "obj", "ply", "off"}) {
    WriteMesh(folder / ("whole." + extension), shapes::Sphere(1.0, 1));
    const std::string whole = ReadFile(folder / ("whole." + extension));
    for (int trial = 0; trial < 200; ++trial) {
      RngStream rng(11, extension, trial);
      std::string bytes = whole;
      for (std::uint64_t i = 0, n = 1 + rng.Below(8); i < n; ++i) {
        // Half the damage goes where the counts are.
        const std::size_t range = rng.Below(2) == 0 ? 200 : bytes.size();
        bytes[rng.Below(std::min(range, bytes.size()))] = static_cast<char>(rng.Below(256));
      }
      try {
        Inspect(ReadMesh(folder.Write("damaged." + extension, bytes)), false);
      } catch (const InputError&) {
      }
    }
  }
}

}  // namespace
}  // namespace antigrasp
