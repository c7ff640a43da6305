// What stands in the wrong place on the command line: files of another kind, words behind --set.
#include <gtest/gtest.h>

#include <filesystem>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/mesh/mesh_file.h"
#include "tests/app/run_binary.h"
#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

namespace fs = std::filesystem;
using cli::Antigrasp;
using cli::ExpectRefused;
using shapes::TempFolder;

TEST(KindsCli, AFileOfAnotherKindIsNamedAsWhatItIs) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/", out = " --out " + dir;
  folder.Write("scores.csv",
               "object,status,num_grasps,graspability,mean\nmug.stl,ok,3,0.001,0.1\n");
  folder.Write("part.stl", ReadFile(folder / "scores.csv"));
  WriteMesh(folder / "cube.obj", shapes::Cube());
  WriteMesh(folder / "cube.stl", shapes::Cube());
  ASSERT_EQ(Antigrasp("dataset make cylinders --count 1 --out " + dir + "set.h5").code, 0);
  const std::string table = dir + "scores.csv", mesh = dir + "cube.obj", sdf = dir + "set.h5";
  const std::string is_table = "is a table of object, status, num_grasps, graspability, ..., not ";
  for (const std::string command : {"evaluate ", "poses ", "trial ", "export ", "perturb random ",
                                    "perturb search ", "sheet ", "figure 1 ", "figure 2 "}) {
    const bool writes = command != "evaluate " && command != "poses " && command != "trial ";
    ExpectRefused(command + table + (writes ? out + (command == "sheet " ? "x.png" : "x.svg") : ""),
                  is_table + "a mesh (");
  }
  ExpectRefused("compare " + sdf + " " + table + out + "c.csv", is_table + "a mesh (");
  ExpectRefused("dataset import " + table + out + "i.h5", is_table + "a mesh (");
  ExpectRefused("info " + dir + "part.stl", is_table + "a mesh (");
  ExpectRefused("dataset import " + sdf + " " + mesh + out + "i.h5", "meshes alone or grids alone");
  ExpectRefused("dataset import " + mesh + " --sign negative-inside" + out + "i.h5",
                "--sign (" + mesh + "): expected grids: meshes have none");
  for (const std::string option : {"--scale each", "--resolution 48", "--units mm"}) {
    ExpectRefused("dataset import " + sdf + " " + option + out + "i.h5",
                  option.substr(0, option.find(' ')) + " (" + sdf +
                      "): expected meshes: grids keep their own");
  }
  ExpectRefused("remesh " + mesh + out + "m", "is a mesh, not an SDF file (");
  ExpectRefused("remesh " + table + out + "m", is_table + "an SDF file (");
  ExpectRefused("quality " + mesh, "is a mesh, not a table (");
  ExpectRefused("quality " + dir + "cube.stl", "is a mesh, not a table (");
  ExpectRefused("quality " + sdf, "is an HDF5 file (as SDF files are), not a table (");
  ExpectRefused("sample " + table + out + "s.h5", is_table + "a checkpoint (");
  ExpectRefused("sample " + dir + "cube.stl" + out + "s.h5", "is a mesh, not a checkpoint (");
  ExpectRefused("generator " + sdf + out + "g.pt", "not a checkpoint (");
  ExpectRefused("train " + table + out + "r", is_table + "a configuration (");
  ExpectRefused("train " + mesh + out + "r", "is a mesh, not a configuration (");
  EXPECT_EQ(shapes::CountFiles(folder.path()), 5);
}

TEST(KindsCli, SetTakesSettingsUpToTheNextOptionAndNothingElse) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/";
  folder.Write("a=b/fine.toml", "[gan]\nbatch = 4\n");
  const std::string config = dir + "a=b/fine.toml", out = " --out " + dir + "run";
  // Every word is looked at: the last of them is out of range, whatever stands around.
  for (const std::string& words :
       {config + " --set cem.episodes=1 gan.batch=0", "--set cem.episodes=1 gan.batch=0 " + config,
        "--set gan.batch=0 " + config + " cem.episodes=1",
        "--set=cem.episodes=1 --set=gan.batch=0 " + config,
        "--set cem.episodes=1 --seed 3 --set gan.batch=0 " + config}) {
    ExpectRefused("train " + words + out, "gan.batch = 0 (--set)");
  }
  // The configuration was read, not passed over.
  folder.Write("a=b/fine.toml", "[gan]\nbatch = 1\n");
  ExpectRefused("train --set cem.episodes=1 " + config + out, "gan.batch = 1 (" + config + ":2)");
  folder.Write("a=b/fine.toml", "[gan]\nbatch = 4\n");
  ExpectRefused("train " + config + " --set cem.episodes=1 stray" + out,
                "stray (--set): expected key=value");
  EXPECT_FALSE(fs::exists(folder / "run"));
}

}  // namespace
}  // namespace antigrasp
