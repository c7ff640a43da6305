#include "antigrasp/datasets/object_names.h"

#include <gtest/gtest.h>

#include <set>

#include "antigrasp/core/rng.h"

namespace antigrasp {
namespace {

using Names = std::vector<std::string>;

TEST(ObjectNames, ANameThatIsOnesOwnStays) {
  EXPECT_EQ(DistinctNames({{"mug.stl", "/a"}, {"deep/cup.obj", "/a"}, {"cylinders-000017", "/b"}}),
            (Names{"mug.stl", "deep/cup.obj", "cylinders-000017"}));
  EXPECT_EQ(DistinctNames({}), Names{});
}

// As YCB and Google's scanned objects lie on disk.
TEST(ObjectNames, AsManyFoldersAsTellTheObjectsApartComeBeforeTheName) {
  EXPECT_EQ(DistinctNames({{"nontextured.stl", "/ycb/001_brick/google_16k"},
                           {"nontextured.stl", "/ycb/002_cube/google_16k"},
                           {"other.stl", "/ycb/002_cube/google_16k"}}),
            (Names{"001_brick/google_16k/nontextured.stl", "002_cube/google_16k/nontextured.stl",
                   "other.stl"}));
  EXPECT_EQ(DistinctNames({{"model.obj", "/gso/Mug/meshes"}, {"model.obj", "/gso/Shoe/meshes"}}),
            (Names{"Mug/meshes/model.obj", "Shoe/meshes/model.obj"}));
  EXPECT_EQ(DistinctNames({{"sample-000000", "/x/batch"}, {"sample-000000", "/x/batch0"}}),
            (Names{"batch/sample-000000", "batch0/sample-000000"}));
}

TEST(ObjectNames, TheExtensionIsWrittenOutWhereItAloneDiffers) {
  EXPECT_EQ(DistinctNames({{"mug.obj", "/pair"}, {"mug.stl", "/pair"}}),
            (Names{"mug_obj", "mug_stl"}));
  EXPECT_EQ(DistinctNames({{"mug.obj", "/a"}, {"mug.stl", "/a"}, {"mug.stl", "/b"}}),
            (Names{"mug_obj", "a/mug.stl", "b/mug.stl"}));
}

TEST(ObjectNames, AnObjectNamedTwiceIsNumbered) {
  EXPECT_EQ(DistinctNames({{"mug.stl", "/a"}, {"mug.stl", "/a"}, {"mug_2", "/c"}}),
            (Names{"mug.stl", "mug_3.stl", "mug_2"}));
  EXPECT_EQ(DistinctNames({{"same", "/set"}, {"same", "/set"}, {"", "/set"}}),
            (Names{"same", "same_2", "unnamed"}));
}

TEST(ObjectNames, TheStreamIsThatOfTheFileNameAloneWhateverItsFolderAndFormat) {
  for (const char* name : {"mug.stl", "mug.obj", "a/mug.stl", "001/google_16k/mug.ply", "mug",
                           "mug_stl", "a/mug_obj"}) {
    EXPECT_EQ(StreamOf(name), HashOf("mug")) << name;
  }
  for (const char* name : {"mug_stl.obj", "mug_obj.obj", "mug_2.stl", "mugs.stl", "mug/cup.stl",
                           "a_mug.stl", "Mug.stl", "_stl", "mug_small.stl", ""}) {
    EXPECT_NE(StreamOf(name), HashOf("mug")) << name;
  }
  EXPECT_EQ(StreamOf("cylinders-000017"), HashOf("cylinders-000017"));
  EXPECT_EQ(StreamOf("v1.2/part 3.5.stl"), HashOf("part 3.5"));
}

TEST(ObjectNames, NoTwoNamesGiveOneFileWhateverTheyAre) {
  std::vector<ObjectOrigin> objects;
  for (const char* folder : {"/a", "/a/b", "/b/a", "/a_b", "/"}) {
    for (const char* name :
         {"m.stl", "b/m.stl", "b_m.stl", "m", "m.obj", "m_obj", "m_2", "a/b/m.stl"}) {
      objects.push_back({name, folder});
      objects.push_back({name, folder});
    }
  }
  std::set<std::string> files;
  for (const std::string& name : DistinctNames(objects)) files.insert(FileNameOf(name));
  EXPECT_EQ(files.size(), objects.size());
  EXPECT_FALSE(files.contains(""));
}

TEST(ObjectNames, FilesAreNamedWithoutFolderSeparatorsAndExtension) {
  EXPECT_EQ(FileNameOf("a/b/mug.stl"), "a_b_mug");
  EXPECT_EQ(FileNameOf("mug.STL"), "mug");
  EXPECT_EQ(FileNameOf("mug.v2"), "mug.v2");
}

}  // namespace
}  // namespace antigrasp
