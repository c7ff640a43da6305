// The command sheet: rows, limits and refusals.
#include <gtest/gtest.h>

#include <filesystem>

#include "antigrasp/mesh/mesh_file.h"
#include "antigrasp/render/image.h"
#include "tests/app/run_binary.h"
#include "tests/support/read_png.h"
#include "tests/support/shapes.h"
#include "tests/support/temp_folder.h"

namespace antigrasp {
namespace {

namespace fs = std::filesystem;
using cli::Antigrasp;
using cli::ExpectRefused;
using cli::Outcome;
using shapes::TempFolder;

bool IsWhite(const Image& image, int x, int y) { return image.At(x, y) == Rgb{255, 255, 255}; }

TEST(SheetCli, DrawsARowPerArgumentAndWrapsASingleOne) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/";
  fs::create_directory(folder / "in");
  for (const char* name : {"a.stl", "b.stl", "c.stl"}) {
    WriteMesh(folder / "in" / name, shapes::Sphere(1.0, 1));
  }
  const std::string size = " --columns 2 --pixels 32 --out " + dir + "s.png";
  ASSERT_EQ(Antigrasp("sheet " + dir + "in" + size).code, 0);
  const Image wrapped = ReadPng(folder / "s.png");
  EXPECT_EQ(wrapped.width, 64);
  EXPECT_EQ(wrapped.height, 64);
  EXPECT_FALSE(IsWhite(wrapped, 16, 48));
  EXPECT_TRUE(IsWhite(wrapped, 48, 48));  // there is no fourth object

  const Outcome rows = Antigrasp("sheet " + dir + "in " + dir + "in/a.stl" + size);
  ASSERT_EQ(rows.code, 0) << rows.text;
  EXPECT_NE(rows.text.find("3 objects in 2 rows, 64 x 64 pixels"), std::string::npos) << rows.text;
}

TEST(SheetCli, RefusesBadInputInOneLineAndWritesNothing) {
  const TempFolder folder;
  const std::string dir = folder.path().string() + "/", out = " --out " + dir + "s.png";
  WriteMesh(folder / "ball.stl", shapes::Sphere(1.0, 1));
  ExpectRefused("sheet " + dir + "none.stl" + out, "no such file");
  ExpectRefused("sheet " + dir + "ball.stl --out " + dir + "none/s.png", "none");
  ExpectRefused("sheet " + dir + "ball.stl --pixels 0" + out, "--pixels");
  ExpectRefused("sheet " + dir + "ball.stl --elevation nan" + out, "nan");
  EXPECT_FALSE(fs::exists(folder / "s.png"));
}

}  // namespace
}  // namespace antigrasp
