// Folders of known sets as they are published: one mesh an object, by the name of its folder.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/datasets/hdf5_tree.h"
#include "antigrasp/datasets/import_request.h"
#include "antigrasp/datasets/mesh_layout.h"
#include "antigrasp/mesh/mesh_file.h"
#include "tests/datasets/imported.h"
#include "tests/support/csv_rows.h"
#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

using shapes::TempFolder;
namespace fs = std::filesystem;

// A box as long as this along x.
void PutBox(const fs::path& path, double length) {
  fs::create_directories(path.parent_path());
  WriteMesh(path, shapes::Box({length, 0.5 * length, 0.25 * length}));
}

void PutGrasps(const fs::path& path, const std::string& mesh, double scale) {
  fs::create_directories(path.parent_path());
  const auto tree = Hdf5Tree::Create(path);
  tree->WriteText("/object/file", mesh);
  tree->Write("/object/scale", {{}, {scale}});
  tree->Close();
}

// What stands for which object, by the path below the folder.
std::map<std::string, std::string> Taken(const FoundMeshes& found, const fs::path& folder) {
  std::map<std::string, std::string> taken;
  for (const FoundMesh& mesh : found.objects) {
    taken[mesh.origin.name] = fs::path(mesh.path).lexically_relative(folder).generic_string();
  }
  return taken;
}

std::string WhySkipped(const FoundMeshes& found, const fs::path& path) {
  for (const auto& [skipped, why] : found.skipped) {
    if (skipped == path.string()) return why;
  }
  return "not skipped";
}

using ByName = std::map<std::string, std::string>;

TEST(MeshLayout, OfYcbTheCoarseScanIsTakenWithoutItsTexture) {
  const TempFolder folder;
  for (const char* file :
       {"google_16k/nontextured.ply", "google_16k/nontextured.stl", "google_16k/textured.obj",
        "google_64k/nontextured.ply", "clouds/merged_cloud.ply", "tsdf/textured.obj"}) {
    PutBox(folder / ("003_cracker_box/" + std::string(file)), 0.2);
  }
  PutBox(folder / "004_sugar_box/google_16k/textured.obj", 0.1);
  PutBox(folder / "004_sugar_box/google_512k/nontextured.ply", 0.1);
  PutBox(folder / "072-a_toy/tsdf/textured.obj", 0.1);
  PutBox(folder / "073_cloud/clouds/merged_cloud.ply", 0.1);
  PutBox(folder / "stray.obj", 0.1);
  const FoundMeshes found = FindMeshes(folder.path());
  EXPECT_EQ(found.layout, "YCB");
  EXPECT_EQ(Taken(found, folder.path()),
            (ByName{{"003_cracker_box", "003_cracker_box/google_16k/nontextured.ply"},
                    {"004_sugar_box", "004_sugar_box/google_16k/textured.obj"},
                    {"072-a_toy", "072-a_toy/tsdf/textured.obj"}}));
  EXPECT_EQ(found.skipped.size(), 8U);
  EXPECT_EQ(WhySkipped(found, folder / "003_cracker_box/google_16k/textured.obj"),
            "of the same object as 003_cracker_box/google_16k/nontextured.ply");
  EXPECT_EQ(WhySkipped(found, folder / "073_cloud/clouds/merged_cloud.ply"),
            "no google_16k/nontextured.ply or another mesh of YCB");
  EXPECT_EQ(WhySkipped(found, folder / "stray.obj"), "in no object's folder of this layout");
}

TEST(MeshLayout, OfShapeNetObjectsAreCalledByCategoryAndNumber) {
  const TempFolder folder;
  PutBox(folder / "02880940/1a0f/models/model_normalized.obj", 1.0);
  PutBox(folder / "03797390/1a0f/models/model_normalized.obj", 2.0);
  const FoundMeshes found = FindMeshes(folder.path());
  EXPECT_EQ(found.layout, "ShapeNet");
  EXPECT_EQ(Taken(found, folder.path()),
            (ByName{{"02880940/1a0f", "02880940/1a0f/models/model_normalized.obj"},
                    {"03797390/1a0f", "03797390/1a0f/models/model_normalized.obj"}}));
  // A category alone, too.
  EXPECT_EQ(FindMeshes(folder / "03797390").objects.at(0).origin.name, "03797390/1a0f");
}

TEST(MeshLayout, OfGoogleScannedObjectsTheFolderIsTheName) {
  const TempFolder folder;
  PutBox(folder / "ACE_Coffee_Mug/meshes/model.obj", 0.1);
  PutBox(folder / "Toy_Car/meshes/model.obj", 0.2);
  const FoundMeshes found = FindMeshes(folder.path());
  EXPECT_EQ(found.layout, "Google Scanned Objects");
  EXPECT_EQ(Taken(found, folder.path()),
            (ByName{{"ACE_Coffee_Mug", "ACE_Coffee_Mug/meshes/model.obj"},
                    {"Toy_Car", "Toy_Car/meshes/model.obj"}}));
}

TEST(MeshLayout, OfAcronymEveryFileOfGraspsIsAnObjectAtItsScale) {
  const TempFolder folder;
  PutBox(folder / "meshes/Mug/10f6.obj", 100.0);
  PutBox(folder / "meshes/Bowl/ab12.obj", 50.0);
  PutBox(folder / "meshes/Bowl/unused.obj", 50.0);
  PutGrasps(folder / "grasps/Mug_10f6_0.001.h5", "meshes/Mug/10f6.obj", 0.001);
  PutGrasps(folder / "grasps/Mug_10f6_0.002.h5", "meshes/Mug/10f6.obj", 0.002);
  PutGrasps(folder / "grasps/Bowl_ab12_0.004.h5", "meshes/Bowl/ab12.obj", 0.004);
  PutGrasps(folder / "grasps/Cup_gone_1.h5", "meshes/Cup/gone.obj", 1.0);
  PutGrasps(folder / "grasps/Out_1.h5", "../../etc/mesh.obj", 1.0);
  PutGrasps(folder / "grasps/Zero_1.h5", "meshes/Mug/10f6.obj", 0.0);
  folder.Write("grasps/torn.h5", ReadFile(folder / "grasps/Zero_1.h5").substr(0, 300));
  const FoundMeshes found = FindMeshes(folder.path());
  EXPECT_EQ(found.layout, "ACRONYM");
  EXPECT_EQ(Taken(found, folder.path()), (ByName{{"Bowl_ab12_0.004", "meshes/Bowl/ab12.obj"},
                                                 {"Mug_10f6_0.001", "meshes/Mug/10f6.obj"},
                                                 {"Mug_10f6_0.002", "meshes/Mug/10f6.obj"}}));
  EXPECT_EQ(WhySkipped(found, folder / "grasps/Cup_gone_1.h5"),
            "its mesh is not there: meshes/Cup/gone.obj");
  EXPECT_EQ(WhySkipped(found, folder / "grasps/Out_1.h5"),
            "/object/file is no mesh of this folder");
  EXPECT_EQ(WhySkipped(found, folder / "grasps/Zero_1.h5"), "no /object/file or /object/scale");
  EXPECT_EQ(WhySkipped(found, folder / "grasps/torn.h5"), "no /object/file or /object/scale");
  EXPECT_EQ(WhySkipped(found, folder / "meshes/Bowl/unused.obj"), "no file of grasps names it");

  // Lengths of 0.1, 0.2 and 0.2: the largest spans 12 of 16 nodes.
  const Imported imported = Import({folder.path()}, 16, 1);
  EXPECT_EQ(imported.set.names,
            (std::vector<std::string>{"Bowl_ab12_0.004", "Mug_10f6_0.001", "Mug_10f6_0.002"}));
  EXPECT_NEAR(imported.set.side, 0.2 / 12 * 16, 1e-9);
  std::map<std::string, double> nodes;
  for (std::size_t i = 0; i < 3; ++i) nodes[imported.set.names[i]] = imported.reports.at(i).nodes;
  EXPECT_NEAR(nodes["Mug_10f6_0.001"], 6.0, 1e-6);
  EXPECT_NEAR(nodes["Mug_10f6_0.002"], 12.0, 1e-6);
}

TEST(MeshLayout, InAnyOtherFolderEveryMeshIsAnObject) {
  const TempFolder folder;
  PutBox(folder / "meshes/mug.obj", 1.0);
  PutBox(folder / "meshes/model.obj", 1.0);  // half of them: no layout
  const FoundMeshes found = FindMeshes(folder.path());
  EXPECT_EQ(found.layout, "");
  EXPECT_EQ(Taken(found, folder.path()), (ByName{{"meshes/model.obj", "meshes/model.obj"},
                                                 {"meshes/mug.obj", "meshes/mug.obj"}}));
  // EGAD's is flat; and a folder of meshes called "meshes" is none of scanned objects.
  EXPECT_EQ(FindMeshes(folder / "meshes").layout, "");
  EXPECT_EQ(FindMeshes(folder / "meshes").objects.at(1).origin.name, "mug.obj");
}

TEST(MeshLayout, GridsAmongMeshesAreSkippedAndReported) {
  const TempFolder folder;
  PutBox(folder / "both/mug.obj", 0.2);
  WriteFileAtomic(folder / "both/grids.npz", "any");
  ImportRequest request;
  request.inputs = {(folder / "both").string()};
  request.out = (folder / "set.h5").string();
  request.report = (folder / "report.csv").string();
  RunImport(request, nullptr);
  const auto rows = shapes::CsvRows(request.report);
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[1].at("path"), (folder / "both/grids.npz").string());
  EXPECT_EQ(rows[1].at("detail"), "grids among meshes: import them by themselves");
}

TEST(MeshLayout, AnImportSaysTheLayoutAndReportsWhatWasSkipped) {
  const TempFolder folder;
  PutBox(folder / "ycb/001_a/google_16k/nontextured.ply", 0.2);
  PutBox(folder / "ycb/001_a/google_16k/textured.obj", 0.2);
  PutBox(folder / "ycb/002_b/google_16k/nontextured.ply", 0.1);
  ImportRequest request;
  request.inputs = {(folder / "ycb").string()};
  request.out = (folder / "set.h5").string();
  request.report = (folder / "report.csv").string();
  const std::string text = RunImport(request, nullptr);
  EXPECT_EQ(text, request.inputs[0] + ": layout of YCB, 2 objects\n" + request.out +
                      ": 2 shapes (2 accepted, 0 repaired, 0 refused, 1 skipped)\n"
                      "longest sides: 14 to 28 of 32 nodes, median 14\n");
  EXPECT_EQ(ReadShapeNames(request.out), (std::vector<std::string>{"001_a", "002_b"}));
  const auto rows = shapes::CsvRows(request.report);
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[2].at("path"), (folder / "ycb/001_a/google_16k/textured.obj").string());
  EXPECT_EQ(rows[2].at("status"), "skipped");
  EXPECT_EQ(rows[2].at("detail"), "of the same object as 001_a/google_16k/nontextured.ply");
  EXPECT_EQ(rows[2].at("nodes"), "");
}

}  // namespace
}  // namespace antigrasp
