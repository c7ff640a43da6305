#include "antigrasp/render/image.h"

#include <gtest/gtest.h>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/error.h"
#include "tests/support/temp_folder.h"

namespace antigrasp {
namespace {

using shapes::TempFolder;

TEST(Png, ComesBackAsItWasWrittenAndTwiceAsTheSameBytes) {
  const TempFolder folder;
  Image image(7, 3, {1, 2, 3});
  image.At(6, 2) = {200, 100, 50};
  WritePng(folder / "a.png", image);
  WritePng(folder / "b.png", image);
  const Image back = ReadPng(folder / "a.png");
  EXPECT_EQ(back.width, 7);
  EXPECT_EQ(back.height, 3);
  EXPECT_EQ(back.pixels, image.pixels);
  EXPECT_EQ(ReadFile(folder / "a.png"), ReadFile(folder / "b.png"));
  EXPECT_EQ(ReadFile(folder / "a.png").substr(1, 3), "PNG");
}

TEST(Png, RefusesWhatIsNoPictureAndFoldersThatAreMissing) {
  const TempFolder folder;
  folder.Write("text.png", "not a picture");
  folder.Write("cut.png", "\x89PNG\r\n\x1a\n");
  EXPECT_THROW(ReadPng(folder / "text.png"), InputError);
  EXPECT_THROW(ReadPng(folder / "cut.png"), InputError);
  EXPECT_THROW(ReadPng(folder / "none.png"), InputError);
  EXPECT_THROW(WritePng(folder / "none/a.png", Image(1, 1)), InputError);
}

TEST(Paste, PutsATileWhereItBelongs) {
  Image image(4, 4);
  Paste(Image(2, 1, {0, 0, 0}), 1, 2, &image);
  int black = 0;
  for (const Rgb& pixel : image.pixels) black += pixel == Rgb{0, 0, 0} ? 1 : 0;
  EXPECT_EQ(black, 2);
  EXPECT_EQ(image.At(1, 2), (Rgb{0, 0, 0}));
  EXPECT_EQ(image.At(2, 2), (Rgb{0, 0, 0}));
}

}  // namespace
}  // namespace antigrasp
