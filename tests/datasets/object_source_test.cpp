// Objects of the command line: their order, names and files, read one by one.
#include <gtest/gtest.h>

#include <filesystem>
#include <optional>

#include "antigrasp/core/error.h"
#include "antigrasp/datasets/objects.h"
#include "antigrasp/datasets/prior_set.h"
#include "antigrasp/mesh/mesh_file.h"
#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

using shapes::TempFolder;
using Names = std::vector<std::string>;

Names NamesOf(const ObjectSource& source) {
  Names names;
  for (std::int64_t i = 0; i < source.size(); ++i) names.push_back(source.name(i));
  return names;
}

// A folder, a file and an SDF file.
std::vector<std::string> Inputs(const TempFolder& folder) {
  std::filesystem::create_directories(folder / "in/b");
  WriteMesh(folder / "in/b/cube.obj", shapes::Cube());
  WriteMesh(folder / "in/box.stl", shapes::Box({1, 2, 3}));
  folder.Write("in/broken.stl", "no mesh");
  WriteMesh(folder / "box.ply", shapes::Box({1, 1, 5}));
  PriorSetOptions options;
  options.count = 2;
  WritePriorSet(folder / "p.h5", options);
  return {(folder / "in").string(), (folder / "box.ply").string(), (folder / "p.h5").string()};
}

TEST(ObjectSource, KnowsNamesAndInputsBeforeAnythingIsRead) {
  const TempFolder folder;
  const ObjectSource source(Inputs(folder));
  EXPECT_EQ(NamesOf(source), (Names{"b/cube.obj", "box_stl", "broken.stl", "box_ply",
                                    "cylinders-000000", "cylinders-000001"}));
  EXPECT_EQ(source.input(0), 0U);
  EXPECT_EQ(source.input(3), 1U);
  EXPECT_EQ(source.input(5), 2U);
}

TEST(ObjectSource, EveryObjectIsReadAloneAndInAnyOrder) {
  const TempFolder folder;
  const ObjectSource source(Inputs(folder));
  PriorSetOptions options;
  options.count = 2;
  const InputObject last = source.Load(5);
  EXPECT_EQ(last.status, "ok");
  EXPECT_EQ(last.name, "cylinders-000001");
  EXPECT_EQ(Bounds(source.Load(3).mesh).Extent(), Eigen::Vector3d(1, 1, 5));
  EXPECT_EQ(Bounds(source.Load(1).mesh).Extent(), Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(source.Load(2).status, "not readable");
  const std::vector<InputObject> all = LoadObjects(source, 3), two = LoadObjects(source, 1, {}, 2);
  ASSERT_EQ(all.size(), 6U);
  EXPECT_EQ(all[5].mesh.vertices, last.mesh.vertices);
  EXPECT_EQ(all[4].name, "cylinders-000000");
  ASSERT_EQ(two.size(), 2U);
  EXPECT_EQ(two[1].name, "box_stl");
}

TEST(ObjectSource, AnObjectsStreamIsItsOwnBesideAnyOthers) {
  const TempFolder folder;
  const std::vector<std::string> inputs = Inputs(folder);
  const ObjectSource all(inputs), alone({(folder / "in/box.stl").string()}),
      turned({inputs[2], inputs[1], inputs[0]});
  EXPECT_EQ(all.stream(1), alone.stream(0));
  EXPECT_EQ(all.stream(1), turned.stream(4));  // "box_stl", to be told from box.ply
  EXPECT_EQ(all.stream(0), StreamOf("cube"));
  EXPECT_EQ(all.stream(5), StreamOf("cylinders-000001"));
  EXPECT_EQ(all.Load(5).stream, all.stream(5));
  EXPECT_EQ(LoadObjects(turned, 2)[4].stream, alone.stream(0));
}

TEST(ObjectSource, RefusesWhatIsThereInNoFormAndSaysSo) {
  const TempFolder folder;
  const auto refuses = [&](const std::string& input, const std::string& words) {
    try {
      const ObjectSource source({input});
      ADD_FAILURE() << input;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
  };
  refuses((folder / "none").string(), "no such file or folder");
  refuses(folder.path().string(), "no object");
  refuses(folder.Write("notes.txt", "x").string(), "not an HDF5 file");
  const auto broken = folder.Write("broken.stl", "no mesh");
  const ObjectSource source({broken.string()});
  EXPECT_THROW(source.Load(0), InputError);
}

TEST(ObjectSource, NamesTheFileThatWouldBeWrittenOver) {
  const TempFolder folder;
  const ObjectSource source(Inputs(folder));
  source.RequireNotRead({folder / "in/box.obj", folder / "other.stl", ""});
  EXPECT_THROW(source.RequireNotRead({folder / "other.stl", folder / "in/../in/box.stl"}),
               InputError);
  EXPECT_THROW(source.RequireNotRead({folder / "p.h5"}), InputError);
}

TEST(ObjectSource, NamesTheFolderWhoseMeshesTheNextCallWouldRead) {
  const TempFolder folder;
  const ObjectSource source(Inputs(folder));  // a folder "in" among them
  source.RequireNotSearched(folder.path());
  source.RequireNotSearched(folder / "in-beside");
  source.RequireNotSearched(folder / "in/../out");
  for (const char* inside : {"in", "in/", "in/new/after", "out/../in/x"}) {
    EXPECT_THROW(source.RequireNotSearched(folder / inside), InputError) << inside;
  }
  const std::filesystem::path inside = std::filesystem::relative(folder / "in");
  EXPECT_THROW(source.RequireNotSearched("not-there-yet" / (".." / inside / "x")), InputError);
}

TEST(ObjectSource, FilesThatKnowTheirUnitAreTurnedIntoThatOfTheCall) {
  const TempFolder folder;
  WriteMesh(folder / "c.stl", shapes::Box({20, 30, 40}));
  const std::vector<std::string> inputs = {ANTIGRASP_TEST_DATA "/tinygltf-two-cubes.glb",
                                           (folder / "c.stl").string()};
  const auto load = [&](std::int64_t i, std::optional<LengthUnit> into) {
    return ObjectSource(inputs, GridUnit::kOfFiles, into).Load(i);
  };
  const auto longest = [&](std::int64_t i, std::optional<LengthUnit> into) {
    return Bounds(load(i, into).mesh).Extent().maxCoeff();
  };
  EXPECT_NEAR(longest(0, std::nullopt), 0.05, 1e-8);
  EXPECT_NEAR(longest(0, LengthUnit::kM), 0.05, 1e-8);
  EXPECT_NEAR(longest(0, LengthUnit::kMm), 50.0, 1e-5);
  EXPECT_NEAR(longest(0, LengthUnit::kIn), 50.0 / 25.4, 1e-6);
  for (const auto into : {LengthUnit::kM, LengthUnit::kMm}) EXPECT_EQ(longest(1, into), 40.0);
  // A unit that was named, and is not the file's, deserves a word.
  const std::string note = load(0, LengthUnit::kMm).note;
  EXPECT_NE(note.find("turned into mm: the file says that it is in m"), std::string::npos) << note;
  EXPECT_EQ(load(0, LengthUnit::kM).note.find("turned"), std::string::npos);
  EXPECT_EQ(load(1, LengthUnit::kMm).note, "");
}

TEST(ObjectSource, CountsStatuses) {
  EXPECT_EQ(CountByStatus({"ok", "empty", "ok", "open: 4 boundary edges", "empty"}),
            "5 objects: 2 ok, 2 empty, 1 open: 4 boundary edges");
}

}  // namespace
}  // namespace antigrasp
