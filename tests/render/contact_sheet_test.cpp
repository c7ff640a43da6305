#include "antigrasp/render/contact_sheet.h"

#include <gtest/gtest.h>

#include "tests/support/shapes.h"

namespace antigrasp {
namespace {

TEST(ContactSheet, SetsObjectsInRowsForAnyNumberOfThreads) {
  const TriangleMesh cube = shapes::Cube(), ball = shapes::Sphere(1.0, 2);
  View view;
  view.pixels = 40;
  const std::vector<std::vector<const TriangleMesh*>> rows = {{&cube, nullptr, &ball}, {&ball}};
  const Image sheet = ContactSheet(rows, view, 1);
  EXPECT_EQ(sheet.width, 120);
  EXPECT_EQ(sheet.height, 80);
  EXPECT_EQ(sheet.pixels, ContactSheet(rows, view, 3).pixels);
  const Image tile = RenderMesh(ball, view), first = RenderMesh(cube, view);
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 40; ++x) {
      EXPECT_EQ(sheet.At(x, y), first.At(x, y));
      EXPECT_EQ(sheet.At(80 + x, y), tile.At(x, y));
      EXPECT_EQ(sheet.At(x, 40 + y), tile.At(x, y));
      EXPECT_EQ(sheet.At(40 + x, y), (Rgb{255, 255, 255}));  // null
      EXPECT_EQ(sheet.At(40 + x, 40 + y), (Rgb{255, 255, 255}));
      EXPECT_EQ(sheet.At(80 + x, 40 + y), (Rgb{255, 255, 255}));
    }
  }
}

TEST(ContactSheet, OfNothingHasNoPixels) { EXPECT_EQ(ContactSheet({}, View{}).pixels.size(), 0u); }

}  // namespace
}  // namespace antigrasp
