// Grasps written for other programs and read again.
#include "antigrasp/grasp_io/grasp_files.h"

#include <gtest/gtest.h>

#include "antigrasp/core/error.h"
#include "antigrasp/mesh/mesh_file.h"
#include "antigrasp/quality/named_gripper.h"
#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

using Eigen::Vector3d;
using shapes::FileContents;

constexpr GraspFormat kAll[] = {GraspFormat::kIsaac, GraspFormat::kGraspGen, GraspFormat::kAcronym,
                                GraspFormat::kMultiGripper, GraspFormat::kDexNet};

// A torus and a box, twenty grasps each.
class GraspFilesTest : public testing::Test {
 protected:
  GraspFilesTest() {
    metric_.num_grasps = 20;
    metric_.num_draws = 5;
    ApplyGripper("panda", &metric_);
    WriteMesh(folder_ / "torus.obj", shapes::Torus(1.0, 0.4, 24, 12));
    WriteMesh(folder_ / "box.obj", shapes::Box({40.0, 45.0, 60.0}));
  }
  GraspOutput Output(const std::string& name, GraspFormat format = GraspFormat::kAuto) const {
    GraspOutput output{(folder_ / name).string(), format, GraspFrame::kMetres, {}};
    output.about.base = BaseOf("panda");
    output.about.metric = metric_;
    return output;
  }
  static std::string ExtensionOf(GraspFormat format) {
    if (format == GraspFormat::kIsaac) return ".yaml";
    if (format == GraspFormat::kAcronym) return ".h5";
    return format == GraspFormat::kDexNet ? ".hdf5" : ".json";
  }
  ObjectSource Objects(const std::vector<std::string>& names) const {
    std::vector<std::string> inputs;
    for (const std::string& name : names) inputs.push_back((folder_ / name).string());
    return ObjectSource(inputs);
  }
  void Write(const GraspOutput& output, const ObjectSource& objects) const {
    GraspFiles files(output, objects);
    for (std::int64_t i = 0; i < objects.size(); ++i) {
      const InputObject object = objects.Load(i);
      files.Add(
          i, ScoreObject(object.name, object.status, object.mesh, objects.stream(i), metric_, 5));
    }
    EXPECT_EQ(files.Commit().size(), 0U);
  }
  GraspsRead Read(const std::string& name, const std::string& gripper = "panda") const {
    return ReadGraspFiles((folder_ / name).string(), BaseOf(gripper), metric_);
  }
  std::string WhyNot(const GraspOutput& output, const ObjectSource& objects) const {
    try {
      Write(output, objects);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  shapes::TempFolder folder_;
  MetricOptions metric_;
};

TEST_F(GraspFilesTest, WhatIsReadAgainScoresTheSameToTheLastBitInEveryFormat) {
  const ObjectSource objects = Objects({"torus.obj"});
  const TriangleMesh mesh = objects.Load(0).mesh;
  const Graspability sampled = EvaluateGraspability(mesh, metric_, 5, objects.stream(0));
  for (const GraspFormat format : kAll) {
    const std::string name = "g" + ExtensionOf(format);
    Write(Output(name, format), objects);
    const GraspsRead read = Read(name);
    EXPECT_TRUE(read.of_mesh_files);
    ASSERT_EQ(read.grasps.size(), 20U) << name;
    const auto scores = ScoreGivenGrasps(mesh, read.grasps, metric_, 5, objects.stream(0));
    for (std::size_t g = 0; g < scores.size(); ++g) {
      EXPECT_EQ(read.grasps[g].object, "torus.obj");
      EXPECT_EQ(read.grasps[g].metres_per_unit, sampled.scale) << name;
      EXPECT_EQ(read.grasps[g].candidate, sampled.grasps[g].candidate) << name;
      EXPECT_EQ(scores[g].status, "ok");
      EXPECT_EQ(scores[g].robust_quality, sampled.grasps[g].quality) << name;
      EXPECT_EQ(scores[g].grasp.width, sampled.grasps[g].grasp.width) << name;
      EXPECT_EQ(scores[g].reachable, true);
      // Matrices keep the way in as it is, turns about an axis to rounding.
      const Vector3d way = sampled.grasps[g].grasp.approach;
      EXPECT_NEAR((scores[g].grasp.approach - way).norm(), 0.0, 1e-15) << name;
      if (format == GraspFormat::kGraspGen || format == GraspFormat::kAcronym) {
        EXPECT_EQ(scores[g].grasp.approach, way);
      }
    }
  }
}

TEST_F(GraspFilesTest, EqualGraspsAreEqualBytes) {
  const ObjectSource objects = Objects({"torus.obj"});
  for (const GraspFormat format : kAll) {
    const std::string extension = ExtensionOf(format);
    Write(Output("a" + extension, format), objects);
    Write(Output("b" + extension, format), objects);
    EXPECT_EQ(ReadFile(folder_ / ("a" + extension)), ReadFile(folder_ / ("b" + extension)));
  }
}

TEST_F(GraspFilesTest, SeveralObjectsAreAFolderOfFilesOrOneFileThatHoldsThemAll) {
  const ObjectSource objects = Objects({"torus.obj", "box.obj"});
  Write(Output("all.hdf5"), objects);
  Write(Output("set", GraspFormat::kAcronym), objects);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "set/box.h5"));
  for (const std::string name : {"all.hdf5", "set"}) {
    const std::vector<GivenGrasp> grasps = Read(name).grasps;
    ASSERT_EQ(grasps.size(), 40U);
    EXPECT_EQ(grasps.front().object, "box.obj");
    EXPECT_EQ(grasps.back().object, "torus.obj");
  }
  EXPECT_EQ(FileContents(folder_ / "set").size(), 2U);
}

TEST_F(GraspFilesTest, PlacesThatCannotBeAreRefusedBeforeAnyWork) {
  const ObjectSource one = Objects({"torus.obj"}), two = Objects({"torus.obj", "box.obj"});
  folder_.Write("full/a.txt", "x");
  EXPECT_NE(WhyNot(Output("g.json"), two).find("2 objects in one file"), std::string::npos);
  EXPECT_NE(WhyNot(Output("full", GraspFormat::kIsaac), two).find("a new or an empty folder"),
            std::string::npos);
  GraspOutput mesh = Output("g.yaml");
  mesh.frame = GraspFrame::kMesh;
  EXPECT_NE(WhyNot(mesh, one).find("all others hold metres"), std::string::npos);
  EXPECT_NE(WhyNot(Output("none/g.json"), one), "");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "g.json"));
}

// The jaws' paths alone are looked at: no way in is found, and no base has a pose.
TEST_F(GraspFilesTest, WithoutAGraspThatHasAWayInNothingIsWritten) {
  metric_.collision = Collision::kJaws;
  const std::string why = WhyNot(Output("g.yaml"), Objects({"torus.obj"}));
  EXPECT_EQ(why.substr(0, why.find(" are left")),
            "no grasp to write: 20 grasps without a way in of the gripper");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "g.yaml"));
}

TEST_F(GraspFilesTest, AnObjectWiderThanTheJawsIsLeftOutAndCounted) {
  WriteMesh(folder_ / "wide.obj", shapes::Box({90.0, 100.0, 110.0}));
  metric_.object_min_extent = 0.0;
  metric_.units = LengthUnit::kMm;
  const ObjectSource objects = Objects({"box.obj", "wide.obj"});
  GraspFiles files(Output("g.hdf5"), objects);
  for (std::int64_t i = 0; i < 2; ++i) {
    const InputObject object = objects.Load(i);
    files.Add(i, ScoreObject(object.name, "ok", object.mesh, objects.stream(i), metric_, 5));
  }
  const std::vector<std::string> notes = files.Commit();
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_TRUE(notes[0].starts_with("1 objects without grasps are left out")) << notes[0];
}

TEST_F(GraspFilesTest, AnotherGrippersGraspsAreRefused) {
  const ObjectSource objects = Objects({"torus.obj"});
  for (const GraspFormat format : kAll) {
    const std::string name = "g" + ExtensionOf(format);
    Write(Output(name, format), objects);
    EXPECT_THROW(Read(name, "robotiq_85"), InputError) << name;
  }
}

// Names that YAML or JSON would take for something else, or cut.
TEST_F(GraspFilesTest, AnyNameOfAnObjectComesBack) {
  const std::string names[] = {"a: b #c", "say \"x\" \\ y", "007",
                               "true",    "tab\there",      "\xc3\xa4.obj"};
  const ObjectSource objects = Objects({"torus.obj"});
  for (const GraspFormat format : kAll) {
    for (const std::string& name : names) {
      GraspSet set{name, 0.5, {}, {{"0", Vector3d::Zero(), Vector3d::UnitX(), Vector3d::UnitZ()}}};
      const std::string file = "g" + ExtensionOf(format);
      GraspFiles files(Output(file, format), objects);
      files.Add(0, set);
      files.Commit();
      EXPECT_EQ(Read(file).grasps.front().object, name) << file;
    }
  }
}

}  // namespace
}  // namespace antigrasp
