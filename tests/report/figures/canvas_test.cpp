#include "antigrasp/report/figures/canvas.h"

#include <gtest/gtest.h>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/error.h"
#include "tests/support/read_png.h"
#include "tests/support/temp_folder.h"
#include "tests/support/well_formed.h"

namespace antigrasp {
namespace {

using shapes::TempFolder;

const char* const kHostile =
    "</svg><script>alert(1)</script> & \"quotes\" 'single' \xe6\x97\xa5\xe6\x9c\xac \xff\xfe\n\t";

void DrawAll(Canvas* canvas) {
  RgbaImage image(6, 4);
  image.At(1, 1) = {200, 10, 10, 255};
  image.At(2, 1) = {10, 10, 200, 128};
  canvas->Picture(image, {10.0, 10.0, 60.0, 40.0});
  canvas->Line({{5.0, 5.0}, {90.0, 40.0}}, kInk, 1.0, {2.0, 1.0});
  canvas->Fill({{50.0, 10.0}, {60.0, 30.0}, {40.0, 30.0}}, kBars.WithAlpha(0.5));
  canvas->Dot({15.0, 15.0}, 9.0, kMark);
  canvas->Frame({10.0, 10.0, 60.0, 40.0}, kMuted, 0.5);
  canvas->Text(kHostile, {50.0, 55.0}, {7.0, kInk, Align::kMiddle});
  canvas->Text("\xce\xba = 0.72", {95.0, 55.0}, {7.0, kInk, Align::kRight, true, true});
}

std::string Page(const TempFolder& folder, const std::string& name) {
  WritePage(folder / name, {100.0, 60.0, 144.0}, &DrawAll);
  return ReadFile(folder / name);
}

TEST(Canvas, AnSvgIsWellFormedAndNoTextBecomesMarkup) {
  const TempFolder folder;
  const std::string svg = Page(folder, "page.svg");
  EXPECT_EQ(shapes::WhyNotWellFormed(svg), "");
  EXPECT_EQ(svg.find("script"), std::string::npos);
  EXPECT_NE(svg.find("data:image/png;base64,"), std::string::npos);
}

TEST(Canvas, TheSameDrawingGivesTheSameBytesLaterInTheProcess) {
  const TempFolder folder;
  for (const char* name : {"a.svg", "a.png"}) {
    const std::string first = Page(folder, name);
    Page(folder, std::string("between-") + name);
    EXPECT_EQ(Page(folder, name), first) << name;
  }
}

TEST(Canvas, APngHasThePixelsOfThePageAndWhatIsDrawn) {
  const TempFolder folder;
  Page(folder, "page.PNG");
  const Image image = ReadPng(folder / "page.PNG");
  EXPECT_EQ(image.width, 200);
  EXPECT_EQ(image.height, 120);
  EXPECT_EQ(image.At(199, 119), (Rgb{255, 255, 255}));
  const Rgb red = image.At(20 + 30, 20 + 30);  // of pixel (1, 1): 20 to 40 and 20 to 40 of 120 x 80
  EXPECT_GT(red[0], 150);
  EXPECT_LT(red[1], 60);
}

TEST(Canvas, WritesNothingForAnUnknownKindOrTooManyPixels) {
  const TempFolder folder;
  EXPECT_THROW(WritePage(folder / "page.pdf", {10.0, 10.0}, &DrawAll), InputError);
  EXPECT_THROW(WritePage(folder / "page", {10.0, 10.0}, &DrawAll), InputError);
  EXPECT_THROW(WritePage(folder / "page.png", {1e5, 10.0}, &DrawAll), InputError);
  EXPECT_THROW(WritePage(folder / "none/page.svg", {10.0, 10.0}, &DrawAll), InputError);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(Printable, ReplacesBytesThatAreNoTextAndKeepsTheRest) {
  EXPECT_EQ(Printable("plain <&\"> \xce\xba \xf0\x9f\xa4\x96"),
            "plain <&\"> \xce\xba \xf0\x9f\xa4\x96");
  EXPECT_EQ(Printable("a\nb\x01"), "a b ");
  EXPECT_EQ(Printable("\xff"), "\xef\xbf\xbd");
  EXPECT_EQ(Printable("\xce"), "\xef\xbf\xbd");                          // cut short
  EXPECT_EQ(Printable("\xc0\xaf"), "\xef\xbf\xbd\xef\xbf\xbd");          // overlong
  EXPECT_EQ(Printable("\xed\xa0\x80").find('\xed'), std::string::npos);  // half a surrogate pair
}

TEST(Canvas, ATextThatIsTooLongEndsInAnEllipsisBetweenTwoCharacters) {
  const TempFolder folder;
  WritePage(folder / "page.svg", {100.0, 60.0}, [](Canvas* canvas) {
    const std::string text = "\xce\xba\xce\xba\xce\xba\xce\xba\xce\xba\xce\xba";
    const std::string cut = canvas->Shortened(text, 0.5 * canvas->TextWidth(text));
    EXPECT_TRUE(cut.ends_with("\xe2\x80\xa6")) << cut;
    EXPECT_EQ(Printable(cut), cut);
    EXPECT_LE(canvas->TextWidth(cut), 0.5 * canvas->TextWidth(text));
    EXPECT_EQ(canvas->Shortened(text, 1000.0), text);
    EXPECT_GT(canvas->TextWidth(text, {14.0}), 1.9 * canvas->TextWidth(text, {7.0}));
  });
}

}  // namespace
}  // namespace antigrasp
