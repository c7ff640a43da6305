#include <gtest/gtest.h>

#include <map>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/error.h"
#include "antigrasp/core/rng.h"
#include "antigrasp/mesh/inspect.h"
#include "antigrasp/mesh/mesh_file.h"
#include "antigrasp/mesh/stable_poses.h"
#include "tests/mesh/unit_files.h"
#include "tests/support/shapes.h"
#include "tests/support/temp_folder.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;
using shapes::CubeGlb;
using shapes::CubeXml;
using shapes::ModelXml;
using shapes::TempFolder;
using shapes::ThreeMfBytes;

constexpr const char* kItem = "<item objectid=\"1\"/>";

MeshFile Read(const std::string& name, const std::string& bytes) {
  const TempFolder folder;
  return ReadMeshFile(folder.Write(name, bytes));
}

MeshFile Read3(const std::string& resources, const std::string& build) {
  return Read("a.3mf", ThreeMfBytes(ModelXml("millimeter", resources, build)));
}

// What the message says, without the path; it is one line.
std::string Refusal(const std::string& name, const std::string& bytes) {
  const TempFolder folder;
  const auto path = folder.Write(name, bytes);
  try {
    ReadMeshFile(path);
  } catch (const InputError& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find(path.string()), std::string::npos) << message;
    EXPECT_NE(message.find("expected"), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    return message;
  }
  return "nothing thrown";
}

std::string Refusal3(const std::string& resources, const std::string& build) {
  return Refusal("a.3mf", ThreeMfBytes(ModelXml("", resources, build)));
}

void ExpectSays(const std::string& message, const std::string& part) {
  EXPECT_NE(message.find(part), std::string::npos) << message;
}

void ExpectBox(const TriangleMesh& mesh, const Vector3d& min, const Vector3d& max) {
  const BoundingBox box = Bounds(mesh);
  EXPECT_TRUE(box.min.isApprox(min, 1e-6) || (box.min - min).norm() < 1e-7) << box.min.transpose();
  EXPECT_TRUE(box.max.isApprox(max, 1e-6)) << box.max.transpose();
}

TEST(ThreeMf, EveryUnitIsKnownAndMillimetresWhereNoneIsNamed) {
  const std::map<std::string, double> units = {
      {"micron", 1e-6}, {"millimeter", 1e-3}, {"", 1e-3},    {"centimeter", 1e-2},
      {"inch", 0.0254}, {"foot", 0.3048},     {"meter", 1.0}};
  for (const auto& [name, metres] : units) {
    const MeshFile file = Read("a.3mf", ThreeMfBytes(ModelXml(name, CubeXml(), kItem)));
    ASSERT_TRUE(file.unit) << name;
    EXPECT_EQ(file.unit->metres, metres) << name;
    EXPECT_TRUE(Inspect(file.mesh).IsSolid()) << name;
    ExpectBox(file.mesh, Vector3d::Zero(), Vector3d::Constant(20.0));
    ExpectBox(InUnit(file, LengthUnit::kMm), Vector3d::Zero(),
              Vector3d::Constant(20.0 * metres / 0.001));
  }
  ExpectSays(Refusal("a.3mf", ThreeMfBytes(ModelXml("parsec", CubeXml(), kItem))), "'parsec'");
}

TEST(ThreeMf, ItemsAndComponentsStandWhereTheyArePlaced) {
  const std::string parts =
      CubeXml() +
      "<object id=\"2\"><components><component objectid=\"1\"/>"
      "<component objectid=\"1\" transform=\"1 0 0 0 1 0 0 0 1 30 0 0\"/></components></object>";
  // A quarter turn about z, rows as points: x goes to y.
  const MeshFile file =
      Read3(parts,
            "<item objectid=\"2\" transform=\"0 1 0 -1 0 0 0 0 2 100 0 0\"/>" + std::string(kItem));
  const MeshReport report = Inspect(file.mesh);
  EXPECT_EQ(report.components, 3);
  EXPECT_TRUE(report.outward);
  EXPECT_NEAR(report.volume, 5 * 8000.0, 1e-6);
  ExpectBox(file.mesh, Vector3d::Zero(), {100, 50, 40});
}

TEST(ThreeMf, MirroredObjectsStayOutward) {
  const MeshFile file =
      Read3(CubeXml(), "<item objectid=\"1\" transform=\"-1 0 0 0 1 0 0 0 1 0 0 0\"/>");
  EXPECT_NEAR(Inspect(file.mesh).volume, 8000.0, 1e-9);
}

TEST(ThreeMf, ObjectsInOtherPartsAreFound) {
  const std::string assembly =
      "<object id=\"7\"><components><component p:path=\"/3D/Objects/cube.model\" "
      "objectid=\"1\"/></components></object>";
  const std::string bytes = ThreeMfBytes(ModelXml("inch", assembly, "<item objectid=\"7\"/>"),
                                         {{"3D/Objects/cube.model", ModelXml("", CubeXml(), "")}});
  const MeshFile file = Read("a.3mf", bytes);
  EXPECT_EQ(file.unit->name, "in");
  EXPECT_NEAR(Inspect(file.mesh).volume, 8000.0, 1e-9);
  ExpectSays(Refusal("a.3mf", ThreeMfBytes(ModelXml("", assembly, "<item objectid=\"7\"/>"))),
             "3D/Objects/cube.model");
}

TEST(ThreeMf, WhatIsNotBuiltIsNotRead) {
  const std::string foreign =
      "<s:slicestack xmlns:s=\"http://schemas.microsoft.com/3dmanufacturing/slice/2015/07\">"
      "<s:vertices><s:vertex x=\"1\" y=\"nonsense\"/></s:vertices></s:slicestack>";
  const std::string support =
      "<object id=\"3\" type=\"support\"><components><component objectid=\"1\"/></components>"
      "</object><object id=\"4\"/>";
  const MeshFile file =
      Read3(foreign + CubeXml() + support,
            "<item objectid=\"3\" transform=\"1 0 0 0 1 0 0 0 1 99 0 0\"/>" + std::string(kItem));
  ExpectBox(file.mesh, Vector3d::Zero(), Vector3d::Constant(20.0));
  ASSERT_EQ(file.notes.size(), 1u);
  EXPECT_EQ(file.notes[0], "1 support objects left out");
}

TEST(ThreeMf, FacesWithoutAreaAreLeftToRepair) {
  EXPECT_EQ(Read3(CubeXml("<triangle v1=\"0\" v2=\"1\" v3=\"1\"/>"), kItem).mesh.faces.size(), 13u);
}

TEST(ThreeMf, FilesOfLib3mfAreRead) {  // made by its writer, version 1.8.1
  const MeshFile file = ReadMeshFile(ANTIGRASP_TEST_DATA "/lib3mf-two-cubes.3mf");
  EXPECT_EQ(file.unit->name, "in");
  EXPECT_NEAR(Inspect(file.mesh).volume, 2 * 8.0, 1e-9);
  ExpectBox(file.mesh, Vector3d::Zero(), {5, 2, 2});
}

TEST(ThreeMf, DamageIsRefusedInOneLine) {
  const std::string whole = ThreeMfBytes(ModelXml("", CubeXml(), kItem));
  ExpectSays(Refusal("a.3mf", whole.substr(0, whole.size() - 100)), "truncated");
  ExpectSays(Refusal("a.3mf", shapes::ZipBytes({{"a.txt", "hello"}})), "without 3MF");
  ExpectSays(Refusal("a.3mf", shapes::ZipBytes({{"_rels/.rels", "<a/>"}})), "without a 3D model");
  ExpectSays(Refusal("a.3mf", ThreeMfBytes("<model/>")), "no 3MF model");
  ExpectSays(Refusal("a.3mf", ThreeMfBytes("<model")), "cube.model");
  ExpectSays(Refusal("a.3mf", ThreeMfBytes("<!DOCTYPE m [<!ENTITY a \"b\">]><m/>")),
             "document type");
  ExpectSays(Refusal3(CubeXml("<triangle v1=\"0\" v2=\"1\" v3=\"8\"/>"), kItem), "number 8");
  ExpectSays(Refusal3(CubeXml("<triangle v1=\"0\" v2=\"1\" v3=\"-1\"/>"), kItem), "number -1");
  ExpectSays(Refusal3(CubeXml("<triangle v1=\"0\" v2=\"1\" v3=\"1e2\"/>"), kItem), "'1e2'");
  ExpectSays(Refusal3(CubeXml("<triangle v1=\"0\" v2=\"1\"/>"), kItem), "v3");
  ExpectSays(Refusal3(CubeXml(), ""), "nothing to build");
  ExpectSays(Refusal3(CubeXml(), "<item objectid=\"2\"/>"), "no object '2'");
  ExpectSays(Refusal3(CubeXml() + CubeXml(), kItem), "second time");
  ExpectSays(Refusal3(CubeXml(), "<item objectid=\"1\" transform=\"1 0 0\"/>"), "twelve");
  ExpectSays(Refusal3("<object id=\"1\"/>", kItem), "no vertices");
}

TEST(ThreeMf, NestingAndPackingAreBounded) {
  ExpectSays(Refusal3("<object id=\"1\"><components><component objectid=\"1\"/></components>"
                      "</object>",
                      kItem),
             "without an end");
  for (const std::string& leaf : {CubeXml(), std::string("<object id=\"1\"/>")}) {
    std::string nested = leaf;
    for (int id = 2; id < 40; ++id) {
      const std::string inner = "<component objectid=\"" + std::to_string(id - 1) + "\"/>";
      nested += "<object id=\"" + std::to_string(id) + "\"><components>";
      for (int i = 0; i < 10; ++i) nested += inner;
      nested += "</components></object>";
    }
    ExpectSays(Refusal3(nested, "<item objectid=\"39\"/>"), "expected");
  }
  const std::string spaces(std::size_t{100} << 20, ' ');
  ExpectSays(Refusal3(CubeXml() + spaces, kItem), "grows beyond");
}

TEST(Glb, IsInMetresAndNodesAreAtTheirPlaces) {
  MeshFile file = Read("a.glb", CubeGlb());
  EXPECT_EQ(file.unit->name, "m");
  EXPECT_TRUE(Inspect(file.mesh).IsSolid());
  ExpectBox(file.mesh, Vector3d::Zero(), Vector3d::Constant(0.02));
  ExpectBox(InUnit(file, LengthUnit::kMm), Vector3d::Zero(), Vector3d::Constant(20.0));
  // Scaled, turned a quarter about z, moved.
  file = Read("a.glb", CubeGlb(R"(,"translation":[1,0,0],"scale":[1,2,3],)"
                               R"("rotation":[0,0,0.70710678118654752,0.70710678118654752])"));
  ExpectBox(file.mesh, {0.96, 0, 0}, {1.0, 0.02, 0.06});
  file = Read("a.glb", CubeGlb(R"(,"matrix":[0,1,0,0,-2,0,0,0,0,0,3,0,1,0,0,1])"));
  ExpectBox(file.mesh, {0.96, 0, 0}, {1.0, 0.02, 0.06});
  file = Read("a.glb", CubeGlb(R"(,"scale":[-1,1,1])"));
  EXPECT_NEAR(Inspect(file.mesh).volume, 8e-6, 1e-12);  // outward, though mirrored
}

TEST(Glb, ChildrenStandInTheirParentsAndOtherScenesAreLeftOut) {
  std::string json = shapes::CubeJson(R"(,"translation":[0,1,0],"children":[1])");
  const auto replace = [&](const std::string& from, const std::string& to) {
    ASSERT_NE(json.find(from), std::string::npos);
    json.replace(json.find(from), from.size(), to);
  };
  replace(R"("scene":0,"scenes":[)", R"("scene":1,"scenes":[{"nodes":[2]},)");
  replace(R"(],"meshes")", R"(,{"mesh":0,"translation":[1,0,0]},{"mesh":7}],"meshes")");
  const MeshFile file = Read("a.glb", shapes::GlbBytes(json, shapes::CubeBin()));
  EXPECT_EQ(Inspect(file.mesh).components, 2);
  ExpectBox(file.mesh, {0, 1, 0}, {1.02, 1.02, 0.02});
}

std::string Changed(const std::string& from, const std::string& to,
                    const std::string& bin = shapes::CubeBin()) {
  std::string json = shapes::CubeJson();
  EXPECT_NE(json.find(from), std::string::npos) << from;
  json.replace(json.find(from), from.size(), to);
  return shapes::GlbBytes(json, bin);
}

TEST(Glb, StripsFansAndPlainVerticesAreFaces) {
  const std::string indices = R"("indices":1)";
  MeshFile file = Read("a.glb", Changed(R"(,"indices":1)", R"(,"mode":5)"));
  EXPECT_EQ(file.mesh.faces.size(), 6u);
  EXPECT_EQ(file.mesh.faces[1], (std::array<std::int32_t, 3>{2, 1, 3}));
  file = Read("a.glb", Changed(R"(,"indices":1)", R"(,"mode":6)"));
  EXPECT_EQ(file.mesh.faces.size(), 6u);
  EXPECT_EQ(file.mesh.faces[5], (std::array<std::int32_t, 3>{0, 6, 7}));
  file = Read("a.glb", Changed(indices, indices + R"(},{"attributes":{"POSITION":0},"mode":1)"));
  EXPECT_EQ(file.mesh.faces.size(), 12u);
  ASSERT_EQ(file.notes.size(), 1u);
  EXPECT_EQ(file.notes[0], "1 primitives of points or lines left out");
}

TEST(Glb, FilesOfTinygltfAreRead) {  // made by its writer, version 2.7.0
  const MeshFile file = ReadMeshFile(ANTIGRASP_TEST_DATA "/tinygltf-two-cubes.glb");
  EXPECT_NEAR(Inspect(file.mesh).volume, 2 * 8e-6, 1e-11);
  ExpectBox(file.mesh, Vector3d::Zero(), {0.05, 0.02, 0.02});
}

TEST(Glb, DamageIsRefusedInOneLine) {
  const auto says = [](const std::string& bytes, const std::string& part) {
    ExpectSays(Refusal("a.glb", bytes), part);
  };
  const std::string whole = CubeGlb(), bin = shapes::CubeBin();
  for (std::size_t size = 1; size < whole.size(); size += 7) {
    says(whole.substr(0, size), "expected");
  }
  says(shapes::GlbBytes("{", bin), "JSON");
  says(shapes::GlbBytes("[" + std::string(100000, '['), bin), "too deep");
  says(shapes::GlbBytes("{}", bin), "no scene");
  std::string far = bin;
  far[96] = 8;
  says(shapes::GlbBytes(shapes::CubeJson(), far), "number 8");
  says(shapes::GlbBytes(shapes::CubeJson(), bin.substr(0, 120)), "beyond its bytes");
  says(Changed(R"("count":8)", R"("count":9)"), "9 elements");
  says(Changed(R"("count":8)", R"("count":1000000000000)"), "beyond its bytes");
  says(Changed(R"("count":8)", R"("count":-1)"), "count");
  says(Changed(R"("byteOffset":0)", R"("byteStride":1099511627776)"), "byteStride");
  says(Changed(R"("byteOffset":96)", R"("byteOffset":1099511627776)"), "beyond its bytes");
  says(Changed(R"("POSITION":0)", R"("POSITION":2)"), "no accessor 2");
  says(Changed("5126", "5122"), "positions");
  says(Changed("5123", "5124"), "indices");
  says(Changed(R"("nodes":[0])", R"("nodes":[0,0])"), "two places");
  says(Changed(R"("nodes":[0])", R"("nodes":[3])"), "no node 3");
  says(Changed(R"("mesh":0)", R"("mesh":0,"children":[0])"), "two places");
  says(Changed(R"("byteLength":168)", R"("uri":"/etc/passwd","byteLength":168)"), "another file");
  says(Changed(R"("scene":0)", R"("extensionsRequired":["KHR_draco_mesh_compression"])"),
       "KHR_draco");
  says(Changed(R"("indices":1)", R"("indices":1,"mode":9)"), "mode 9");
  says(Changed(R"("count":36)", R"("count":35)"), "three a triangle");
  says(Changed(R"("mesh":0)", R"("mesh":0,"scale":[1,"a",1])"), "scale");
}

// A box of 20 x 30 x 40 mm.
TEST(KnownUnits, TheSameSolidStandsAlikeFromEveryFile) {
  const TempFolder folder;
  WriteMesh(folder / "a.stl", shapes::Box({20, 30, 40}));
  folder.Write("a.glb", CubeGlb(R"(,"scale":[1,1.5,2])"));
  folder.Write("a.3mf",
               ThreeMfBytes(ModelXml(
                   "centimeter", CubeXml(),
                   "<item objectid=\"1\" transform=\"0.1 0 0 0 0.15 0 0 0 0.2 0 0 0\"/>")));
  const auto poses = [&](const std::string& name) {
    const TriangleMesh mesh = InUnit(ReadMeshFile(folder / name), LengthUnit::kMm);
    return StablePoses(mesh, Inspect(mesh).center_of_mass);
  };
  const std::vector<StablePose> expected = poses("a.stl");
  ASSERT_EQ(expected.size(), 6u);
  EXPECT_NEAR(expected[0].com_height, 10.0, 1e-6);
  for (const char* name : {"a.3mf", "a.glb"}) {
    const std::vector<StablePose> found = poses(name);
    ASSERT_EQ(found.size(), expected.size()) << name;
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_NEAR(found[i].probability, expected[i].probability, 1e-6) << name;
      EXPECT_NEAR(found[i].com_height, expected[i].com_height, 1e-5) << name;
    }
  }
}

TEST(KnownUnits, DamagedFilesNeverDoMoreThanThrowInputError) {
  const TempFolder folder;
  const std::map<std::string, std::string> whole = {
      {"a.glb", CubeGlb(R"(,"translation":[1,0,0])")},
      {"a.3mf", ThreeMfBytes(ModelXml("inch", CubeXml(), kItem))}};
  for (const auto& [name, bytes] : whole) {
    for (int trial = 0; trial < 150; ++trial) {
      RngStream rng(12, name, trial);
      std::string damaged = bytes;
      for (std::uint64_t i = 0, n = 1 + rng.Below(4); i < n; ++i) {
        damaged[rng.Below(damaged.size())] = static_cast<char>(rng.Below(256));
      }
      try {
        Inspect(ReadMesh(folder.Write(name, damaged)), false);
      } catch (const InputError&) {
      }
    }
  }
  for (int trial = 0; trial < 150; ++trial) {  // within the archive
    RngStream rng(13, "model", trial);
    std::string model = ModelXml("inch", CubeXml(), kItem);
    for (std::uint64_t i = 0, n = 1 + rng.Below(4); i < n; ++i) {
      model[rng.Below(model.size())] = static_cast<char>(rng.Below(256));
    }
    try {
      Inspect(ReadMesh(folder.Write("a.3mf", ThreeMfBytes(model))), false);
    } catch (const InputError&) {
    }
  }
}

}  // namespace
}  // namespace antigrasp
