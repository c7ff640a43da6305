#include "antigrasp/report/page/page.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace antigrasp {
namespace {

constexpr const char* kTemplate =
    "<title>ANTIGRASP_TITLE</title><script>\"ANTIGRASP_REPORT_JSON\"</script><script>"
    "ANTIGRASP_BLOB_BASE64</script>end";

TEST(Page, FillsEveryMarkerOnceWhateverTheDataHolds) {
  const ReportPayload payload{R"({"a":"ANTIGRASP_BLOB_BASE64 ANTIGRASP_TITLE"})", "foobar"};
  EXPECT_EQ(FillTemplate(kTemplate, "ANTIGRASP_BLOB_BASE64", payload),
            "<title>ANTIGRASP_BLOB_BASE64</title><script>" + payload.json +
                "</script><script>Zm9vYmFy</script>end");
}

TEST(Page, AnElementHoldsAQuarterOfAMillionCharactersOfTheBlobAtMost) {
  const std::string full(3 << 16, '\0');
  const std::string as(1 << 18, 'A');
  const std::string begin = "<title>t</title><script>{}</script><script>";
  EXPECT_EQ(FillTemplate(kTemplate, "t", {"{}", full}), begin + as + "</script>end");
  EXPECT_EQ(FillTemplate(kTemplate, "t", {"{}", full + "foobar"}),
            begin + as +
                "</script>\n<script type=\"application/octet-stream\" class=\"antigrasp-blob\">"
                "Zm9vYmFy</script>end");
}

TEST(Page, TitleIsText) {
  const std::string page = FillTemplate(kTemplate, "</title><script>alert('\"&\")", {"{}", ""});
  EXPECT_TRUE(
      page.starts_with("<title>&lt;/title&gt;&lt;script&gt;alert(&#39;&quot;&amp;&quot;)</title>"))
      << page;
}

TEST(Page, TemplateWithoutAMarkerOrWithTwoIsABug) {
  EXPECT_THROW(FillTemplate("<html></html>", "t", {}), std::logic_error);
  EXPECT_THROW(FillTemplate(std::string(kTemplate) + "ANTIGRASP_TITLE", "t", {}), std::logic_error);
}

}  // namespace
}  // namespace antigrasp
