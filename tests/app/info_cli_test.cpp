// `antigrasp info` of tables: what they say as a whole, for a person and for a program.
#include <gtest/gtest.h>

#include <filesystem>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/datasets/shape_set.h"
#include "antigrasp/mesh/mesh_file.h"
#include "antigrasp/sdf/sdf_grid.h"
#include "tests/app/run_binary.h"
#include "tests/support/shapes.h"
#include "tests/support/temp_folder.h"

namespace antigrasp {
namespace {

namespace fs = std::filesystem;
using cli::Antigrasp;
using cli::ExpectRefused;
using shapes::TempFolder;

constexpr const char* kMeansHeader =
    "objects,ok,graspability_before,graspability_after,reduction_pct,reduction_half_width_95,"
    "normal_max_deg,hausdorff_pct,volume_pct\n";

// Means 2 and 1.5, without a doubt about the quarter that is lost.
TEST(InfoCli, SaysTheMeansOfPerturbedObjects) {
  const TempFolder folder;
  const std::string dir = folder.path().string();
  folder.Write("perturb.csv",
               "object,status,graspability_before,graspability_after,normal_max_deg,hausdorff_pct,"
               "volume_change_pct\na,ok,1,0.75,8,0.5,-3\nb,after: open: 3,,,,,\n"
               "c,ok,3,2.25,12,1,4\n");
  EXPECT_EQ(Antigrasp("info " + dir + " --csv").text,
            std::string(kMeansHeader) + "3,2,2,1.5,25,0,10,0.75,3.5\n");
  EXPECT_EQ(Antigrasp("info " + dir).text,
            dir +
                ": perturbed objects\n"
                "2 of 3 objects perturbed: mean graspability 2.00000 -> 1.50000, kappa reduced "
                "by 25.0 +-0.0 %\n"
                "mean over objects: largest turn of a normal 10.0 degrees, Hausdorff distance "
                "0.75 % of the diagonal\n"
                "failed: 1 after: open\n");
}

TEST(InfoCli, SaysHowFarScoresLieBelowThoseOfTheOriginals) {
  const TempFolder folder;
  const std::string header =
      "object,status,num_grasps,graspability,ci_low,ci_high,mean,fraction_nonzero,seconds";
  folder.Write("paired.csv", header +
                                 ",baseline,difference\na,ok,100,0.75,0,1,0.5,1,0,1,-0.25\n"
                                 "b,open,,,,,,,,,\nc,few_grasps,9,2.25,0,3,2,1,0,3,-0.75\n");
  folder.Write("scores.csv", header + "\na,ok,100,0.75,0,1,0.5,1,0\n");
  const std::string paired = (folder / "paired.csv").string();
  const std::string scores = (folder / "scores.csv").string();
  EXPECT_EQ(Antigrasp("info " + paired + " --csv").text,
            std::string(kMeansHeader) + "3,2,2,1.5,25,0,,,\n");
  EXPECT_EQ(Antigrasp("info " + paired).text,
            paired +
                ": scores, 2 of 3 objects scored\n  graspability  1.50000\n"
                "  originals     2.00000\n  reduction     25.0 +-0.0 %\n");
  EXPECT_EQ(Antigrasp("info " + scores).text,
            scores + ": scores, 1 of 1 objects scored\n  graspability  0.75000\n");
}

TEST(InfoCli, SaysOfATruncatedFileThatItIs) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/";
  ShapeSet set;
  set.names = {"one"};
  set.grids = {UnitCubeGrid(16)};
  WriteShapeSet(folder / "s.h5", set);
  const std::string bytes = ReadFile(folder / "s.h5");
  folder.Write("cut.h5", std::string_view(bytes).substr(0, bytes.size() - 100));
  ExpectRefused("info " + dir + "cut.h5", "truncated HDF5 file (" + dir + "cut.h5)");
  WriteMesh(folder / "m.stl", shapes::Cube());
  const std::string mesh = ReadFile(folder / "m.stl");
  folder.Write("cut.stl", std::string_view(mesh).substr(0, mesh.size() - 1));
  ExpectRefused("info " + dir + "cut.stl",
                "truncated binary STL, or a wrong count: 11 faces by its 683 bytes, 12 by");
}

TEST(InfoCli, SaysOfATruncatedCheckpointThatItIs) {
  const TempFolder folder;
  const std::string path = folder.Write("cut.pt", "PK\x03\x04 and no more of the archive").string();
  ExpectRefused("info " + path, "truncated or damaged checkpoint (" + path + ")");
  ExpectRefused("info " + folder.Write("no.pt", "text").string(), "unknown kind of file");
}

const std::string kStatistics =
    "stage,samples,ok,non_finite,empty,touches_border,gaps,non_manifold,non_orientable,"
    "self_intersecting,disjoint,scored,without_grasps,graspability,half_width_95,count,"
    "elite_threshold,coverage,nna,duplicates,diversity\n";

std::string Stage(int stage, const std::string& graspability, const std::string& half_width) {
  return std::to_string(stage) + ",9,9,0,0,0,0,0,0,0,0,9,0," + graspability + "," + half_width +
         ",9,0,0,0,0,0\n";
}

// 1 by 4 with half widths 0 and 1: 0.25 +- 0.25 x 0.25.
TEST(InfoCli, SaysKappaOfARunOfWhichOnlyTheTablesWereKept) {
  const TempFolder folder;
  const std::string dir = folder.path().string();
  fs::create_directories(folder / "control");
  fs::create_directories(folder / "other");
  folder.Write("statistics.csv",
               kStatistics + Stage(-1, "4", "1") + Stage(0, "2", "0") + Stage(1, "1", "0"));
  folder.Write("control/statistics.csv", kStatistics + Stage(1, "5", "0"));
  folder.Write("other/statistics.csv", kStatistics + Stage(1, "8", "0"));
  const std::string header =
      "control,stage,graspability,graspability_half_width_95,kappa_prior,"
      "kappa_prior_half_width_95,kappa_episode_0,kappa_episode_0_half_width_95,kappa_control,"
      "kappa_control_half_width_95\n";
  const std::string own = Antigrasp("info " + dir + " --csv").text;
  EXPECT_TRUE(own.starts_with(header)) << own;
  EXPECT_NE(own.find("\n0,0,2,0,0.5,0.125,1,0,,\n0,1,1,0,0.25,0.0625,0.5,0,0.2,0\n"
                     "1,1,5,0,1.25,0.3125,2.5,0,,\n"),
            std::string::npos)
      << own;
  const std::string other = Antigrasp("info " + dir + " --csv --control " + dir + "/other").text;
  EXPECT_NE(other.find("\n0,1,1,0,0.25,0.0625,0.5,0,0.125,0\n"), std::string::npos) << other;
  const std::string text = Antigrasp("info " + dir).text;
  EXPECT_TRUE(text.starts_with(dir + ": antigrasp run\nepisode ")) << text;
  EXPECT_NE(text.find("0.25 +-0.06"), std::string::npos) << text;
}

TEST(InfoCli, RefusesTablesOfWhatHasNoneAndControlsThatAreNoRun) {
  const TempFolder folder;
  const std::string dir = folder.path().string();
  WriteMesh(folder / "cube.stl", shapes::Cube());
  fs::create_directories(folder / "run");
  folder.Write("run/statistics.csv", kStatistics);
  folder.Write("odd.csv", "a,b\n1,2\n");
  ExpectRefused("info " + dir + "/cube.stl --csv", "no table of " + dir + "/cube.stl (--csv)");
  ExpectRefused("info " + dir + "/run --control " + dir,
                "not the folder of a run (--control " + dir);
  ExpectRefused("info " + dir + "/odd.csv", "odd.csv");
}

}  // namespace
}  // namespace antigrasp
