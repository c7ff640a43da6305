// COLLADA by assimp: unit, axes, places of nodes, and files that it must not die of.
#include <gtest/gtest.h>

#include <string>

#include "antigrasp/core/error.h"
#include "antigrasp/core/rng.h"
#include "antigrasp/mesh/inspect.h"
#include "antigrasp/mesh/mass_properties.h"
#include "antigrasp/mesh/mesh_file.h"
#include "tests/support/temp_folder.h"

namespace antigrasp {
namespace {

using shapes::TempFolder;

// The corner of 1 x 2 x 3 as four triangles, placed by this node.
std::string Dae(const std::string& asset, const std::string& node,
                const std::string& faces =
                    "<triangles count=\"4\"><input semantic=\"VERTEX\" source=\"#v\" "
                    "offset=\"0\"/><p>0 2 1 0 1 3 1 2 3 0 3 2</p></triangles>") {
  return "<?xml version=\"1.0\"?>\n<COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" "
         "version=\"1.4.1\">\n<asset><created>2020-01-01</created><modified>2020-01-01</modified>" +
         asset +
         "</asset>\n<library_geometries><geometry id=\"g\"><mesh><source id=\"p\"><float_array "
         "id=\"pa\" "
         "count=\"12\">0 0 0 1 0 0 0 2 0 0 0 3</float_array><technique_common><accessor "
         "source=\"#pa\" "
         "count=\"4\" stride=\"3\"><param name=\"X\" type=\"float\"/><param name=\"Y\" "
         "type=\"float\"/>"
         "<param name=\"Z\" type=\"float\"/></accessor></technique_common></source><vertices "
         "id=\"v\">"
         "<input semantic=\"POSITION\" source=\"#p\"/></vertices>" +
         faces +
         "</mesh></geometry></library_geometries>\n<library_visual_scenes><visual_scene id=\"s\">" +
         node +
         "</visual_scene></library_visual_scenes>\n<scene><instance_visual_scene "
         "url=\"#s\"/></scene>\n"
         "</COLLADA>\n";
}
const std::string kInstance = "<instance_geometry url=\"#g\"/>";
const std::string kPlain = "<node id=\"n\">" + kInstance + "</node>";

TEST(ReadDae, KnowsItsUnitAndKeepsItsAxes) {
  const TempFolder folder;
  const auto centimetres = folder.Write(
      "a.dae", Dae("<unit name=\"centimeter\" meter=\"0.01\"/><up_axis>Z_UP</up_axis>", kPlain));
  const MeshFile file = ReadMeshFile(centimetres);
  ASSERT_TRUE(file.unit.has_value());
  EXPECT_EQ(file.unit->name, "cm");
  EXPECT_EQ(file.unit->metres, 0.01);
  EXPECT_EQ(file.mesh.vertices.size(), 4U);  // equal positions are one vertex
  EXPECT_EQ(file.mesh.faces.size(), 4U);
  EXPECT_NEAR(Volume(file.mesh), 1.0, 1e-12);
  EXPECT_EQ(Bounds(file.mesh).Extent(), Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(Bounds(InUnit(file, LengthUnit::kMm)).Extent(), Eigen::Vector3d(10, 20, 30));
  for (const char* up : {"X_UP", "Y_UP"}) {
    const auto path = folder.Write(
        "b.dae", Dae("<unit meter=\"0.0254\"/><up_axis>" + std::string(up) + "</up_axis>", kPlain));
    EXPECT_EQ(ReadMeshFile(path).unit->name, "in");
    EXPECT_EQ(Bounds(ReadMesh(path)).Extent(), Eigen::Vector3d(1, 2, 3)) << up;
  }
  EXPECT_EQ(ReadMeshFile(folder.Write("c.dae", Dae("", kPlain))).unit->name, "m");
  EXPECT_EQ(ReadMeshFile(folder.Write("d.dae", Dae("<unit meter=\"0.3\"/>", kPlain))).unit->name,
            "0.3 m");
}

TEST(ReadDae, PutsEveryCopyWhereItsNodesAre) {
  const TempFolder folder;
  const std::string nodes =
      "<node id=\"a\"><translate>10 0 0</translate><node id=\"b\"><scale>-1 1 1</scale>" +
      kInstance + "</node></node><node id=\"c\">" + kInstance + "</node>";
  const MeshFile file = ReadMeshFile(folder.Write("a.dae", Dae("<unit meter=\"0.001\"/>", nodes)));
  EXPECT_EQ(file.mesh.faces.size(), 8U);
  EXPECT_NEAR(Volume(file.mesh), 2.0, 1e-12);  // the mirrored one faces outward, too
  EXPECT_EQ(Bounds(file.mesh).min, Eigen::Vector3d(0, 0, 0));
  EXPECT_EQ(Bounds(file.mesh).max, Eigen::Vector3d(10, 2, 3));
}

TEST(ReadDae, PolygonsBecomeTriangles) {
  const TempFolder folder;
  const std::string faces =
      "<polylist count=\"2\"><input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/><vcount>3 "
      "4</vcount>"
      "<p>0 2 1 0 1 3 2</p></polylist>";
  EXPECT_EQ(ReadMesh(folder.Write("a.dae", Dae("", kPlain, faces))).faces.size(), 3U);
}

std::string WhyNot(const std::string& bytes) {
  const TempFolder folder;
  const auto path = folder.Write("a.dae", bytes);
  try {
    ReadMesh(path);
  } catch (const InputError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find(path.string()), std::string::npos) << text;
    EXPECT_EQ(text.find('\n'), std::string::npos) << text;
    return text;
  }
  return "read";
}

TEST(ReadDae, WhatIsDamagedOrNoColladaIsRefused) {
  EXPECT_NE(WhyNot("<html></html>").find("no COLLADA"), std::string::npos);
  const std::string whole = Dae("", kPlain);
  EXPECT_NE(WhyNot(whole.substr(0, 700)).find("damaged COLLADA"), std::string::npos);
  EXPECT_NE(WhyNot(Dae("", "<node id=\"n\"/>")).find("COLLADA"), std::string::npos);
  EXPECT_NE(WhyNot(Dae("<unit meter=\"-1\"/>", kPlain)).find("a unit of"), std::string::npos);
  std::string endless = "<node id=\"n\"><instance_node url=\"#n\"/>" + kInstance + "</node>";
  EXPECT_NE(WhyNot(Dae("", endless)), "");  // whatever it is, it ends
}

// Bytes overwritten at random: whatever comes of it is a mesh or an InputError.
TEST(ReadDae, DamagedFilesNeverDoMoreThanThrowInputError) {
  const TempFolder folder;
  const std::string whole = Dae("<unit meter=\"0.01\"/>", kPlain);
  for (int trial = 0; trial < 200; ++trial) {
    RngStream rng(13, "dae", trial);
    std::string bytes = whole;
    for (std::uint64_t i = 0, n = 1 + rng.Below(6); i < n; ++i) {
      bytes[rng.Below(bytes.size())] = "0123456789-<>\"/ #ev"[rng.Below(19)];
    }
    try {
      Inspect(ReadMesh(folder.Write("damaged.dae", bytes)), false);
    } catch (const InputError&) {
    }
  }
}

}  // namespace
}  // namespace antigrasp
