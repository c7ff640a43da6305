// Files of grasps that are damaged, empty or something else: one line each, and nothing crashes.
#include <gtest/gtest.h>

#include <functional>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/error.h"
#include "antigrasp/grasp_io/grasp_files.h"
#include "antigrasp/quality/named_gripper.h"
#include "tests/support/shapes.h"
#include "tests/support/temp_folder.h"

namespace antigrasp {
namespace {

using shapes::TempFolder;

const std::string kIsaac = "format: isaac_grasp\nformat_version: '1.0'\n";
const std::string kPose =
    "    position: [0, 1.0e-3, +0.5]\n    orientation: {w: 1, xyz: [0, 0, 0]}\n";

class HostileGrasps : public testing::Test {
 protected:
  std::vector<GivenGrasp> Read(const std::string& name) const {
    MetricOptions metric;
    return ReadGraspFiles((folder_ / name).string(), BaseOf("yumi"), metric).grasps;
  }
  // What is wrong with a file of these bytes, without its path.
  std::string WhyNot(const std::string& name, const std::string& bytes) const {
    const std::string path = folder_.Write(name, bytes).string();
    try {
      Read(name);
    } catch (const InputError& error) {
      const std::string why = error.what();
      EXPECT_EQ(why.find('\n'), std::string::npos) << why;
      EXPECT_NE(why.find(path), std::string::npos) << why;
      return why.substr(0, why.find(" ("));
    }
    return "";
  }
  TempFolder folder_;
};

TEST_F(HostileGrasps, OfIsaacAreRefusedInALine) {
  EXPECT_EQ(WhyNot("a.yaml", kIsaac + "grasps:\n  g:\n" + kPose), "");
  EXPECT_NEAR(Read("a.yaml")[0].center.z(), 0.63, 1e-12);  // 130 mm in front of the base
  EXPECT_EQ(WhyNot("a.yaml", ""), "YAML without format: isaac_grasp");
  EXPECT_EQ(WhyNot("a.yaml", "format: other\n"), "YAML without format: isaac_grasp");
  EXPECT_EQ(WhyNot("a.yaml", "- 1\n- 2\n"), "YAML without format: isaac_grasp");
  EXPECT_EQ(WhyNot("a.yaml", kIsaac + "a: [1, 2\n"), "damaged YAML in line 4");
  EXPECT_EQ(WhyNot("a.yaml", kIsaac), "no grasps");
  EXPECT_EQ(WhyNot("a.yaml", kIsaac + "grasps: {}\n"), "no grasps");
  EXPECT_EQ(WhyNot("a.yaml", kIsaac + "grasps: [1]\n"), "no grasps");
  EXPECT_EQ(WhyNot("a.yaml", kIsaac + "grasps: {g: 3}\n"), "grasp g");
  EXPECT_EQ(WhyNot("a.yaml", kIsaac + "grasps: {g: {position: [0, 0]}}\n"), "grasp g");
  EXPECT_EQ(WhyNot("a.yaml", kIsaac + "object_scale: -1\ngrasps:\n  g:\n" + kPose),
            "object_scale = -1");
  const std::string nested(100000, '[');
  EXPECT_EQ(WhyNot("a.yaml", kIsaac + "grasps: " + nested).substr(0, 12), "damaged YAML");
  EXPECT_EQ(WhyNot("a.yaml", std::string(9 << 20, ' ')), "YAML larger than 8 MiB");
}

TEST_F(HostileGrasps, OfJsonAreRefusedInALine) {
  const std::string rows = "[[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]";
  const auto gen = [&](const std::string& transforms, const std::string& more = "") {
    return "{\"object\":{\"file\":\"a.obj\"" + more + "},\"grasps\":{\"transforms\":" + transforms +
           "}}";
  };
  EXPECT_EQ(WhyNot("a.json", gen("[" + rows + "]")), "");
  EXPECT_NEAR(Read("a.json")[0].center.z(), 0.13, 1e-12);
  EXPECT_FALSE(Read("a.json")[0].says_scale);
  EXPECT_EQ(WhyNot("a.json", gen("[" + rows + "]", ",\"scale\":0.5")), "");
  EXPECT_EQ(Read("a.json")[0].metres_per_unit, 0.5);
  EXPECT_EQ(WhyNot("a.json", ""), "damaged JSON");
  EXPECT_EQ(WhyNot("a.json", gen("[" + rows)), "damaged JSON");
  EXPECT_EQ(WhyNot("a.json", "[]"), "no grasps of a known kind");
  EXPECT_EQ(WhyNot("a.json", gen("[]")), "no grasps");
  EXPECT_EQ(WhyNot("a.json", gen("[[1]]")), "grasp 0");
  EXPECT_EQ(WhyNot("a.json", gen("[[[1,0,0,\"x\"],[],[],[]]]")), "grasp 0");
  EXPECT_EQ(WhyNot("a.json", gen("[" + rows + "]", ",\"scale\":0")), "object scale = 0");
  EXPECT_EQ(WhyNot("a.json", "{\"pose\":[[0,0,0,1,0,0]]}"), "grasp 0");
  EXPECT_EQ(WhyNot("a.json", std::string(1'000'000, '[')), "damaged JSON");
  EXPECT_EQ(WhyNot("a.json", "{\"pose\":[[0,0,0,0,0,0,0]]}"), "");  // counted as no pose
  EXPECT_FALSE(Read("a.json")[0].center.allFinite());
  // ACRONYM's twin, and an asset whose z is the gripper's x.
  EXPECT_EQ(WhyNot("a.json", "{\"transforms\":[" + rows + "],\"object_scale\":2}"), "");
  EXPECT_EQ(Read("a.json")[0].metres_per_unit, 2.0);
  EXPECT_EQ(WhyNot("a.json",
                   "{\"gripper\":{\"transform_offset_from_asset_to_graspgen_convention\":"
                   "[0,0,1,0, 0,1,0,0, -1,0,0,0, 0,0,0,1]},\"grasps\":{\"transforms\":[" +
                       rows + "]}}"),
            "");
  EXPECT_EQ(Read("a.json")[0].approach, Eigen::Vector3d::UnitX());
}

TEST_F(HostileGrasps, OfHdf5AreRefusedInALine) {
  EXPECT_EQ(WhyNot("a.h5", "object,grasp\n"), "no HDF5");
  EXPECT_EQ(WhyNot("a.h5", "\x89HDF\r\n\x1a\n"), "damaged HDF5");
  const auto file = [&](const std::function<void(Hdf5Tree*)>& fill) {
    const auto tree = Hdf5Tree::Create(folder_ / "made.h5");
    fill(tree.get());
    tree->Close();
    return ReadFile(folder_ / "made.h5");
  };
  EXPECT_EQ(WhyNot("a.h5", file([](Hdf5Tree* tree) { tree->Group("/sdf"); })),
            "HDF5 without grasps");
  EXPECT_EQ(WhyNot("a.h5", file([](Hdf5Tree* tree) { tree->Group("/grasps"); })),
            "no readable /grasps/transforms");
  EXPECT_EQ(
      WhyNot("a.h5", file([](Hdf5Tree* tree) { tree->WriteText("/grasps/transforms", "none"); })),
      "no readable /grasps/transforms");
  EXPECT_EQ(WhyNot("a.h5", file([](Hdf5Tree* tree) {
                     tree->Write("/grasps/transforms", {{1, 4, 3}, std::vector<double>(12)});
                   })),
            "no readable /grasps/transforms");
  const auto one = [](Hdf5Tree* tree, double scale) {
    tree->Write("/grasps/transforms",
                {{1, 4, 4}, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}});
    tree->Write("/object/scale", {{}, {scale}});
  };
  EXPECT_EQ(WhyNot("a.h5", file([&](Hdf5Tree* tree) { one(tree, 0.0); })), "/object/scale is none");
  const std::string good = file([&](Hdf5Tree* tree) { one(tree, 2.0); });
  EXPECT_EQ(WhyNot("a.h5", good), "");
  EXPECT_EQ(WhyNot("a.h5", good.substr(0, good.size() / 2)), "damaged HDF5");
  EXPECT_EQ(WhyNot("a.hdf5", file([](Hdf5Tree* tree) { tree->Group("/datasets/a/objects/b"); })),
            "no grasps");
  EXPECT_EQ(WhyNot("a.hdf5", file([](Hdf5Tree* tree) {
                     tree->Group("/datasets/a/objects/b/grasps/yumi/grasp_0");
                   })),
            "no readable /datasets/a/objects/b/grasps/yumi/grasp_0@configuration");
}

// A byte of the structure, which check sums see, or of the numbers, which are then others.
TEST_F(HostileGrasps, AnyChangedByteOfAnHdf5FileIsRefusedOrRead) {
  {
    GraspFileAbout about;
    GraspSet set{"a.obj", 2.0, shapes::Cube(), {}};
    for (int i = 0; i < 3; ++i) {
      set.grasps.push_back(
          {"0", {0.1, 0.2, 0.3}, Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitZ()});
    }
    WriteAcronym(folder_ / "good.h5", set, about);
  }
  const std::string good = ReadFile(folder_ / "good.h5");
  int refused = 0, read = 0;
  for (std::size_t at = 8; at < good.size(); at += 41) {
    std::string bytes = good;
    bytes[at] = static_cast<char>(bytes[at] ^ 0xff);
    (WhyNot("a.h5", bytes).empty() ? read : refused) += 1;
  }
  EXPECT_GT(refused, 10);
  EXPECT_GT(read, 10);
}

TEST_F(HostileGrasps, OfAFolderWithoutAnyAreRefused) {
  folder_.Write("set/a.csv", "x\n");
  EXPECT_THROW(Read("set"), InputError);
  EXPECT_THROW(Read("none.json"), InputError);
}

}  // namespace
}  // namespace antigrasp
