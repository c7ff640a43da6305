#include "antigrasp/report/page/page.h"

#include <algorithm>
#include <array>

#include "antigrasp/core/check.h"
#include "antigrasp/core/markup.h"
#include "antigrasp/report/page/base64.h"

namespace antigrasp {
namespace {

// The blob in several script elements, so that the page can draw the first objects while the
// browser still reads the last: a browser shows a script what an element holds when the next one
// has begun.
std::string BlobElements(std::string_view blob) {
  constexpr std::size_t kPiece = 3 << 16;  // bytes: whole groups of base 64
  std::string text;
  text.reserve(blob.size() / 3 * 4 + blob.size() / kPiece * 80 + 4);
  for (std::size_t at = 0; at < blob.size(); at += kPiece) {
    if (at > 0) {
      text += "</script>\n<script type=\"application/octet-stream\" class=\"antigrasp-blob\">";
    }
    text += Base64(blob.substr(at, kPiece));
  }
  return text;
}

}  // namespace

std::string FillTemplate(std::string_view page_template, const std::string& title,
                         const ReportPayload& payload) {
  struct Marker {
    std::string_view text;
    std::string value;
    std::size_t at = 0;
  };
  std::array<Marker, 3> markers = {Marker{"ANTIGRASP_TITLE", MarkupEscaped(title)},
                                   Marker{"\"ANTIGRASP_REPORT_JSON\"", payload.json},
                                   Marker{"ANTIGRASP_BLOB_BASE64", BlobElements(payload.blob)}};
  for (Marker& marker : markers) {
    marker.at = page_template.find(marker.text);
    AG_CHECK(marker.at != std::string_view::npos &&
                 page_template.find(marker.text, marker.at + 1) == std::string_view::npos,
             "every marker of the report's template is there once");
  }
  std::sort(markers.begin(), markers.end(),
            [](const Marker& a, const Marker& b) { return a.at < b.at; });
  std::string page;
  std::size_t done = 0;
  for (const Marker& marker : markers) {
    page.append(page_template.substr(done, marker.at - done)).append(marker.value);
    done = marker.at + marker.text.size();
  }
  return page.append(page_template.substr(done));
}

}  // namespace antigrasp
