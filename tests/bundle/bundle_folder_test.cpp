#include "antigrasp/bundle/bundle_folder.h"

#include <gtest/gtest.h>

#include "antigrasp/core/error.h"
#include "antigrasp/mesh/mesh_file.h"
#include "tests/bundle/dented_solids.h"
#include "tests/support/csv_rows.h"

namespace antigrasp {
namespace {

class BundleFolder : public testing::Test {
 protected:
  BundleFolder() {
    WriteMesh(folder_ / "l.obj", shapes::LShape());
    WriteMesh(folder_ / "open.obj", shapes::FlatSquare());
    request_.out = folder_ / "out";
    request_.scale = ObjectScale::kTrue;
  }

  BundleReport Write(const std::vector<std::string>& names) {
    request_.inputs.clear();
    for (const std::string& name : names) request_.inputs.push_back(folder_ / name);
    return WriteBundles(request_, &silent_);
  }

  std::string Refusal(const std::vector<std::string>& names) {
    try {
      Write(names);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  shapes::TempFolder folder_;
  BundleRequest request_;
  SilentObserver silent_;
};

TEST_F(BundleFolder, HoldsAFolderAnObjectAndATable) {
  Write({"l.obj"});
  std::vector<std::string> paths;
  for (const auto& [path, bytes] : shapes::FileContents(request_.out)) paths.push_back(path);
  EXPECT_EQ(paths, (std::vector<std::string>{"bundle.csv", "l/README.md", "l/l.stl", "l/l.urdf",
                                             "l/l.usda", "l/l.xml", "l/l_part_00.stl",
                                             "l/l_part_01.stl", "l/model.config", "l/model.sdf",
                                             "l/self_check.sdf", "l/self_check.usda",
                                             "l/self_check.xml", "l/self_check_bullet.py"}));
  const auto rows = shapes::CsvRows(folder_ / "out/bundle.csv");
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0].at("status"), "ok");
  EXPECT_EQ(rows[0].at("parts"), "2");
  EXPECT_NEAR(std::stod(rows[0].at("mass")), 0.024, 1e-9);
  EXPECT_EQ(rows[0].at("metres_per_unit"), "1");
}

TEST_F(BundleFolder, HoldsOnlyWhatItIsFor) {
  using Names = std::vector<std::string>;
  const std::vector<std::pair<BundleTarget, Names>> files{
      {BundleTarget::kMujoco, {"l/l.xml", "l/self_check.xml"}},
      {BundleTarget::kUrdf, {"l/l.urdf", "l/self_check_bullet.py"}},
      {BundleTarget::kSdformat, {"l/model.config", "l/model.sdf", "l/self_check.sdf"}},
      {BundleTarget::kUsd, {"l/l.usda", "l/self_check.usda"}}};
  for (const auto& [target, expected] : files) {
    request_.target = target;
    request_.overwrite = true;
    Write({"l.obj"});
    Names others;
    for (const auto& [path, bytes] : shapes::FileContents(request_.out)) {
      if (!path.ends_with(".stl") && !path.ends_with(".csv") && !path.ends_with(".md")) {
        others.push_back(path);
      }
    }
    EXPECT_EQ(others, expected);
  }
}

TEST_F(BundleFolder, MeshesAreInMetresAtTheSizeAskedFor) {
  request_.scale = ObjectScale::kMinExtent;
  request_.options.min_extent = 0.05;  // of the 20 mm that it is thick
  Write({"l.obj"});
  const Eigen::Vector3d extent = Bounds(ReadMesh(folder_ / "out/l/l.stl")).Extent();
  EXPECT_TRUE(extent.isApprox(Eigen::Vector3d(0.1, 0.1, 0.05), 1e-6)) << extent.transpose();
  const auto rows = shapes::CsvRows(folder_ / "out/bundle.csv");
  EXPECT_NEAR(std::stod(rows[0].at("metres_per_unit")), 2.5, 1e-9);
}

TEST_F(BundleFolder, IsScaledByTheRuleOfEgadForTheGripper) {
  request_.scale = ObjectScale::kEgad;
  Write({"l.obj"});  // 40 x 40 x 20 mm, and a panda opens 80 mm
  const auto rows = shapes::CsvRows(folder_ / "out/bundle.csv");
  EXPECT_NEAR(std::stod(rows[0].at("metres_per_unit")), 2.0, 0.05);
}

TEST_F(BundleFolder, LeavesOutAndCountsWhatIsNoSolid) {
  const BundleReport report = Write({"l.obj", "open.obj"});
  ASSERT_EQ(report.warnings.size(), 1u);
  EXPECT_NE(report.warnings[0].find("open.obj: left out: open"), std::string::npos);
  EXPECT_TRUE(report.text.starts_with("1 of 2 objects in ")) << report.text;
  EXPECT_EQ(shapes::CsvRows(folder_ / "out/bundle.csv")[1].at("parts"), "");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out/open"));
}

TEST_F(BundleFolder, IsNotWrittenWithoutASolid) {
  EXPECT_NE(Refusal({"open.obj"}).find("expected a closed solid"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(request_.out));
}

TEST_F(BundleFolder, LeavesOutWhatIsWiderThanTheGripperOpens) {
  WriteMesh(folder_ / "cube.obj", shapes::Cube());
  request_.gripper = "panda";
  const BundleReport report = Write({"l.obj", "cube.obj"});
  ASSERT_EQ(report.warnings.size(), 1u);
  EXPECT_EQ(report.warnings[0],
            "cube.obj: left out: 1 m wide where it is narrowest: the gripper opens 80 mm");
}

TEST_F(BundleFolder, LeavesOutWhatItsFilesCannotBeCalled) {
  for (const char* name : {"self_check.obj", "bundle.csv.obj", "\xff.obj"}) {
    WriteMesh(folder_ / name, shapes::LShape());
  }
  Write({"l.obj", "self_check.obj", "bundle.csv.obj", "\xff.obj"});
  const auto rows = shapes::CsvRows(folder_ / "out/bundle.csv");
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(rows[1].at("status"),
            "its name begins with self_check, as the files of the self-check do");
  EXPECT_EQ(rows[2].at("status"), "its folder would be called as the table is");
  EXPECT_EQ(rows[3].at("status"), "its name is no UTF-8: no XML can hold it");
  request_.out.clear();
  EXPECT_EQ(Refusal({"l.obj"}), "--out \"\" (bundle): expected a folder");
}

// An L of some centimetres 5 km away: single precision knows half a millimetre there.
TEST_F(BundleFolder, LeavesOutWhatSinglePrecisionWouldBend) {
  const TriangleMesh far = Transformed(shapes::LShape(), 1.0, {5000.0, 5000.0, 0.0});
  WriteMesh(folder_ / "far.obj", far);
  EXPECT_EQ(Refusal({"far.obj"}),
            "too far from the origin for STL's single precision: move it there (" +
                (folder_ / "far.obj").string() + "): expected a closed solid");
}

TEST_F(BundleFolder, IsRefusedWhereItIsUsedAndReplacedWhenAskedTo) {
  Write({"l.obj"});
  const auto before = shapes::FileContents(request_.out);
  EXPECT_NE(Refusal({"l.obj"}).find("holds bundle.csv already"), std::string::npos);
  EXPECT_EQ(shapes::FileContents(request_.out), before);
  folder_.Write("out/l/notes.txt", "mine");
  request_.overwrite = true;
  request_.options.parts = 1;
  request_.target = BundleTarget::kMujoco;
  Write({"l.obj"});
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out/l/l_part_01.stl"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out/l/l.urdf"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "out/l/notes.txt"));
}

TEST_F(BundleFolder, IsTheSameForAnyNumberOfThreads) {
  WriteMesh(folder_ / "u.obj", shapes::UShape());
  request_.threads = 1;
  Write({"l.obj", "u.obj"});
  const auto one = shapes::FileContents(request_.out);
  request_.threads = 2;
  request_.overwrite = true;
  Write({"l.obj", "u.obj"});
  EXPECT_EQ(shapes::FileContents(request_.out), one);
}

TEST_F(BundleFolder, IsNotAmongTheObjectsOfTheNextCall) {
  request_.inputs = {folder_.path()};
  EXPECT_THROW(WriteBundles(request_, &silent_), InputError);
  EXPECT_FALSE(std::filesystem::exists(request_.out));
}

}  // namespace
}  // namespace antigrasp
