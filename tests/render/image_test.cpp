#include "antigrasp/render/image.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/error.h"
#include "tests/support/read_png.h"
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

// Both files by hand: signature, IHDR, the rows stored without compression, IEND.
TEST(Png, HoldsRedGreenBlueRowByRowFromTheTopLeft) {
  const std::string bytes(
      "\x89\x50\x4e\x47\x0d\x0a\x1a\x0a\x00\x00\x00\x0d\x49\x48\x44\x52\x00\x00\x00\x02\x00\x00"
      "\x00\x02\x08\x02\x00\x00\x00\xfd\xd4\x9a\x73\x00\x00\x00\x19\x49\x44\x41\x54\x78\x01\x01"
      "\x0e\x00\xf1\xff\x00\xc8\x64\x32\x01\x02\x03\x00\x00\x00\x00\xff\xfe\xfd\x17\x36\x04\x5f"
      "\xe0\x96\x7c\x38\x00\x00\x00\x00\x49\x45\x4e\x44\xae\x42\x60\x82",
      82);
  const TempFolder folder;
  folder.Write("a.png", bytes);
  const Image image = ReadPng(folder / "a.png");
  ASSERT_EQ(image.width, 2);
  ASSERT_EQ(image.height, 2);
  EXPECT_EQ(image.At(0, 0), (Rgb{200, 100, 50}));
  EXPECT_EQ(image.At(1, 0), (Rgb{1, 2, 3}));
  EXPECT_EQ(image.At(0, 1), (Rgb{0, 0, 0}));
  EXPECT_EQ(image.At(1, 1), (Rgb{255, 254, 253}));
  EXPECT_EQ(image.pixels[1], (Rgb{1, 2, 3}));
}

TEST(Png, WhatIsTransparentIsReadOnWhite) {
  const std::string bytes(
      "\x89\x50\x4e\x47\x0d\x0a\x1a\x0a\x00\x00\x00\x0d\x49\x48\x44\x52\x00\x00\x00\x02\x00\x00"
      "\x00\x01\x08\x06\x00\x00\x00\xf4\x22\x7f\x8a\x00\x00\x00\x14\x49\x44\x41\x54\x78\x01\x01"
      "\x09\x00\xf6\xff\x00\x0a\x14\x1e\x00\xc8\x64\x32\xff\x07\x48\x02\x9a\xa4\x2e\xa3\x60\x00"
      "\x00\x00\x00\x49\x45\x4e\x44\xae\x42\x60\x82",
      77);
  const TempFolder folder;
  folder.Write("a.png", bytes);
  const Image image = ReadPng(folder / "a.png");
  ASSERT_EQ(image.pixels.size(), 2u);
  EXPECT_EQ(image.At(0, 0), (Rgb{255, 255, 255}));
  EXPECT_EQ(image.At(1, 0), (Rgb{200, 100, 50}));
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
  EXPECT_THROW(Paste(Image(2, 1), 3, 0, &image), std::logic_error);  // beyond the right border
  EXPECT_THROW(Paste(Image(1, 2), 0, 3, &image), std::logic_error);
  int black = 0;
  for (const Rgb& pixel : image.pixels) black += pixel == Rgb{0, 0, 0} ? 1 : 0;
  EXPECT_EQ(black, 2);
  EXPECT_EQ(image.At(1, 2), (Rgb{0, 0, 0}));
  EXPECT_EQ(image.At(2, 2), (Rgb{0, 0, 0}));
}

}  // namespace
}  // namespace antigrasp
