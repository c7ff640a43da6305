// The folder that a command fills: when it is used, what gives way, what stays.
#include "antigrasp/datasets/result_folder.h"

#include <gtest/gtest.h>

#include <set>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/error.h"
#include "antigrasp/mesh/mesh_file.h"
#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

namespace fs = std::filesystem;
using shapes::TempFolder;

const ResultFiles kFiles{"table.csv", {"sheet.png"}, {"NAME.stl", "after/NAME.stl"}};

// Objects "mug" and "box/lid" beside the folder of results.
ObjectSource Objects(const TempFolder& folder) {
  fs::create_directories(folder / "in/box");
  WriteMesh(folder / "in/mug.obj", shapes::Cube());
  WriteMesh(folder / "in/box/lid.obj", shapes::Cube());
  return ObjectSource({(folder / "in").string()});
}

std::set<std::string> FilesUnder(const fs::path& folder) {
  std::set<std::string> files;
  for (const auto& [file, bytes] : shapes::FileContents(folder)) files.insert(file);
  return files;
}

std::string WhyRefused(const fs::path& folder, const ObjectSource& objects, bool overwrite) {
  try {
    const ResultFolder results(folder, kFiles, objects, overwrite);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

// As a call does that gives a mesh of every object.
void Fill(const TempFolder& folder, const ObjectSource& objects, const std::string& bytes) {
  ResultFolder results(folder / "out", kFiles, objects, true);
  fs::create_directory(results.path() / "after");
  for (const char* file : {"mug.stl", "box_lid.stl", "after/mug.stl"}) {
    WriteFileAtomic(results.path() / file, bytes);
  }
  results.Commit("object\nmug.obj\nbox/lid.obj\n");
}

TEST(ResultFolder, ATableInPiecesIsThatOfOnePieceAndThereAtTheEndAlone) {
  const TempFolder folder;
  const ObjectSource objects = Objects(folder);
  Fill(folder, objects, "old");
  {
    ResultFolder results(folder / "out", kFiles, objects, true);
    results.AddToTable("object\nmug.obj");
    results.AddToTable("");
    results.AddToTable("\nsecond\n");
    EXPECT_EQ(ReadFile(results.table()), "object\nmug.obj\nbox/lid.obj\n");
    results.Commit("last\n");
  }
  EXPECT_EQ(FilesUnder(folder / "out"), (std::set<std::string>{"table.csv"}));
  EXPECT_EQ(ReadFile(folder / "out/table.csv"), "object\nmug.obj\nsecond\nlast\n");
  {
    ResultFolder results(folder / "out", kFiles, objects, true);
    results.AddToTable("of a call that fails\n");
  }
  EXPECT_EQ(ReadFile(folder / "out/table.csv"), "object\nmug.obj\nsecond\nlast\n");
}

TEST(ResultFolder, IsUsedWhenItHoldsTheTableOrAFileThatTheCallCouldWrite) {
  for (const char* file :
       {"table.csv", "sheet.png", "mug.stl", "box_lid.stl", "after/box_lid.stl"}) {
    const TempFolder folder;
    const ObjectSource objects = Objects(folder);
    folder.Write(std::string("out/") + file, "of an earlier call");
    const std::string out = (folder / "out").string();
    EXPECT_EQ(WhyRefused(out, objects, false),
              std::string("holds ") + file + " already (" + out +
                  "): expected a new folder, or --overwrite to replace what an earlier call wrote");
    EXPECT_EQ(WhyRefused(out, objects, true), "");
    EXPECT_EQ(ReadFile(folder / "out" / file), "of an earlier call") << "nothing was committed";
  }
}

TEST(ResultFolder, IsNotUsedWhenWhatItHoldsIsOfOthers) {
  const TempFolder folder;
  const ObjectSource objects = Objects(folder);
  for (const char* file : {"mug.obj", "other.stl", "before/mug.stl", "print.csv"}) {
    folder.Write(std::string("out/") + file, "mine");
  }
  EXPECT_EQ(WhyRefused(folder / "out", objects, false), "");
  EXPECT_EQ(WhyRefused(folder / "new", objects, false), "");
  EXPECT_FALSE(fs::exists(folder / "new"));
}

TEST(ResultFolder, WhatTheTableNamesGivesWayAndOtherFilesStay) {
  const TempFolder folder;
  Fill(folder, Objects(folder), "old");
  folder.Write("out/other.stl", "mine");
  folder.Write("out/after/other.stl", "mine");
  folder.Write("out/sheet.png", "old");
  fs::remove_all(folder / "in/box");
  const ObjectSource fewer({(folder / "in").string()});
  {
    ResultFolder results(folder / "out", kFiles, fewer, true);
    WriteFileAtomic(results.path() / "mug.stl", "new");
    EXPECT_EQ(ReadFile(folder / "out/mug.stl"), "old") << "before Commit()";
    EXPECT_TRUE(fs::exists(folder / "out/box_lid.stl"));
    results.Commit("object\nmug.obj\n");
  }
  EXPECT_EQ(FilesUnder(folder / "out"),
            (std::set<std::string>{"after/other.stl", "mug.stl", "other.stl", "table.csv"}));
  EXPECT_EQ(ReadFile(folder / "out/mug.stl"), "new");
  EXPECT_EQ(ReadFile(folder / "out/table.csv"), "object\nmug.obj\n");
}

TEST(ResultFolder, FoldersThatOnlyOldFilesFilledGoWithThem) {
  const TempFolder folder;
  Fill(folder, Objects(folder), "old");
  fs::create_directory(folder / "out/mine");
  ResultFolder results(folder / "out", kFiles, Objects(folder), true);
  results.Commit("object\nmug.obj\n");
  EXPECT_FALSE(fs::exists(folder / "out/after"));
  EXPECT_TRUE(fs::exists(folder / "out/mine")) << "of somebody else";
  EXPECT_TRUE(fs::exists(folder / "out/table.csv"));
}

// The table says in which format an earlier call wrote; of another format a file is somebody's own.
TEST(ResultFolder, AColumnOfFilesIsTakenAtItsWordAndReachesIntoNoOtherFolder) {
  const TempFolder folder;
  const ObjectSource objects = Objects(folder);
  folder.Write("mine.stl", "mine");
  for (const char* file : {"old.ply", "old.stl", "sub/deep.stl"}) {
    folder.Write(std::string("out/") + file, file);
  }
  folder.Write("out/table.csv",
               "object,file\nold,old.ply\na,../mine.stl\nb,sub/deep.stl\nc,\nd,gone.stl\n");
  ResultFolder(folder / "out", kFiles, objects, true).Commit("object\n");
  EXPECT_EQ(FilesUnder(folder / "out"),
            (std::set<std::string>{"old.stl", "sub/deep.stl", "table.csv"}));
  EXPECT_TRUE(fs::exists(folder / "mine.stl"));
}

TEST(ResultFolder, ADamagedTableKeepsNobodyFromOverwritingIt) {
  const TempFolder folder;
  const ObjectSource objects = Objects(folder);
  folder.Write("out/table.csv", "object,\"file\nnever closed");
  ResultFolder(folder / "out", kFiles, objects, true).Commit("object\n");
  EXPECT_EQ(ReadFile(folder / "out/table.csv"), "object\n");
}

TEST(ResultFolder, AnObjectsFileIsNeitherWrittenOverNorRemoved) {
  const TempFolder folder;
  Fill(folder, Objects(folder), "old");
  WriteMesh(folder / "out/box_lid.stl", shapes::Cube());
  const ObjectSource its_own({(folder / "out/box_lid.stl").string()});
  EXPECT_NE(WhyRefused(folder / "out", its_own, true).find("over an object's file"),
            std::string::npos);
  // Not of this call's objects, but named by the table.
  WriteMesh(folder / "in/box_lid.stl", shapes::Cube());
  const ObjectSource renamed(
      {(folder / "out/box_lid.stl").string(), (folder / "in/box_lid.stl").string()});
  EXPECT_NE(WhyRefused(folder / "out", renamed, true).find("over an object's file"),
            std::string::npos);
  EXPECT_TRUE(fs::exists(folder / "out/box_lid.stl"));
}

TEST(ResultFolder, AFolderInPlaceOfAFileIsNamedBeforeAnythingGoes) {
  const TempFolder folder;
  const ObjectSource objects = Objects(folder);
  folder.Write("out/sheet.png", "old");
  fs::create_directories(folder / "out/mug.stl");
  EXPECT_NE(WhyRefused(folder / "out", objects, true).find("is a folder"), std::string::npos);
  EXPECT_TRUE(fs::exists(folder / "out/sheet.png"));
  fs::create_directories(folder / "table/table.csv");
  EXPECT_NE(WhyRefused(folder / "table", objects, true).find("is a folder"), std::string::npos);
  EXPECT_TRUE(fs::exists(folder / "table/table.csv"));
}

TEST(ResultFolder, WhatIsInTheWayOfAFolderIsNamedBeforeAnythingGoes) {
  const TempFolder folder;
  const ObjectSource objects = Objects(folder);
  folder.Write("file/after", "mine");
  folder.Write("elsewhere/mug.stl", "mine");
  folder.Write("link/sheet.png", "old");
  fs::create_directory_symlink(folder / "elsewhere", folder / "link/after");
  for (const char* out : {"file", "link"}) {
    for (const bool overwrite : {false, true}) {
      EXPECT_NE(WhyRefused(folder / out, objects, overwrite).find("is in the way of a folder"),
                std::string::npos)
          << out << overwrite;
    }
  }
  EXPECT_EQ(ReadFile(folder / "elsewhere/mug.stl"), "mine");
  EXPECT_EQ(ReadFile(folder / "link/sheet.png"), "old");
}

}  // namespace
}  // namespace antigrasp
