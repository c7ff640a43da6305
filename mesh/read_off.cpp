#include <array>

#include "antigrasp/core/error.h"
#include "antigrasp/mesh/mesh_readers.h"
#include "antigrasp/mesh/text_scanner.h"

namespace antigrasp {
namespace {

// The next line that is more than a comment.
std::string_view NextData(TextScanner* text, const std::string& expected) {
  while (const auto line = text->NextLine()) {
    const std::string_view data = line->substr(0, line->find('#'));
    std::string_view rest = data;
    if (!TakeWord(&rest).empty()) return data;
  }
  text->Fail("file ends early", expected);
}

// Takes "OFF" with its optional prefixes off the line. Nothing needs to follow it, but some data
// sets glue the counts to it ("OFF490 518 0").
void TakeHeader(std::string_view* line, const TextScanner& text) {
  std::string_view word = TakeWord(line);
  const std::string_view whole = word;
  for (const std::string_view prefix : {"ST", "C", "N"}) {
    if (word.starts_with(prefix)) word.remove_prefix(prefix.size());
  }
  if (!word.starts_with("OFF")) text.Fail(Quoted(whole), "'OFF' at the start of the file");
  word.remove_prefix(3);
  if (!word.empty()) *line = {word.data(), static_cast<std::size_t>(line->end() - word.begin())};
  std::string_view rest = *line;
  if (TakeWord(&rest) == "BINARY") text.Fail("binary OFF", "ASCII OFF");
}

std::int64_t TakeInteger(std::string_view* line, const std::string& what, const TextScanner& text) {
  const std::string_view word = TakeWord(line);
  const auto value = ParseInteger(word);
  if (!value || *value < 0) text.Fail(what + " " + Quoted(word), "a whole number from 0");
  return *value;
}

}  // namespace

PolygonSoup ReadOff(std::string_view bytes, const std::string& path) {
  TextScanner text(bytes, path);
  std::string_view line = NextData(&text, "'OFF' at the start of the file");
  TakeHeader(&line, text);
  std::string_view rest = line;
  if (TakeWord(&rest).empty()) line = NextData(&text, "the numbers of vertices and faces");
  const std::int64_t vertices = TakeInteger(&line, "number of vertices", text);
  const std::int64_t faces = TakeInteger(&line, "number of faces", text);

  PolygonSoup soup;
  for (std::int64_t i = 0; i < vertices; ++i) {
    line = NextData(&text, std::to_string(vertices) + " vertices");
    Eigen::Vector3d v;
    for (int k = 0; k < 3; ++k) {
      const std::string_view word = TakeWord(&line);
      const auto value = ParseNumber(word);
      if (!value) text.Fail("vertex coordinate " + Quoted(word), "three numbers");
      v[k] = *value;
    }
    soup.vertices.push_back(v);
  }
  for (std::int64_t i = 0; i < faces; ++i) {
    line = NextData(&text, std::to_string(faces) + " faces");
    const std::int64_t corners = TakeInteger(&line, "number of corners", text);
    for (std::int64_t k = 0; k < corners; ++k) {
      soup.corners.push_back(TakeInteger(&line, "face corner", text));
    }
    soup.EndPolygon();
  }
  return soup;
}

}  // namespace antigrasp
