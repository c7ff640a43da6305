#include "antigrasp/core/error.h"
#include "antigrasp/mesh/mesh_readers.h"
#include "antigrasp/mesh/text_scanner.h"

namespace antigrasp {
namespace {

// One line without its comment, joined with the next ones as long as it ends in a backslash.
// `storage` holds the text when lines had to be joined.
std::optional<std::string_view> NextStatement(TextScanner* text, std::string* storage) {
  auto line = text->NextLine();
  if (!line) return std::nullopt;
  line = line->substr(0, line->find('#'));
  if (!line->ends_with('\\')) return line;
  storage->assign(line->substr(0, line->size() - 1));
  while ((line = text->NextLine())) {
    const bool goes_on = line->ends_with('\\');
    *storage += ' ';
    storage->append(line->substr(0, line->size() - (goes_on ? 1 : 0)));
    if (!goes_on) break;
  }
  return *storage;
}

// A weight or a colour may follow the position; both are ignored.
Eigen::Vector3d ReadPosition(std::string_view rest, const TextScanner& text) {
  Eigen::Vector3d v;
  for (int k = 0; k < 3; ++k) {
    const std::string_view word = TakeWord(&rest);
    const auto value = ParseNumber(word);
    if (!value) text.Fail("vertex coordinate " + Quoted(word), "three numbers after 'v'");
    v[k] = *value;
  }
  return v;
}

// "7", "7/1", "7//3" or "7/1/3"; negative numbers count back from the last vertex so far.
std::int64_t ReadCorner(std::string_view word, std::size_t vertices, const TextScanner& text) {
  const auto index = ParseInteger(word.substr(0, word.find('/')));
  if (!index || *index == 0) {
    text.Fail("face corner " + Quoted(word),
              "a vertex number counted from 1, or from -1 backwards");
  }
  return *index > 0 ? *index - 1 : static_cast<std::int64_t>(vertices) + *index;
}

}  // namespace

// Positions and faces of all objects and groups; every other statement is skipped, whatever it is.
PolygonSoup ReadObj(std::string_view bytes, const std::string& path) {
  TextScanner text(bytes, path);
  PolygonSoup soup;
  std::string storage;
  while (auto line = NextStatement(&text, &storage)) {
    std::string_view rest = *line;
    const std::string_view keyword = TakeWord(&rest);
    if (keyword == "v") {
      soup.vertices.push_back(ReadPosition(rest, text));
    } else if (keyword == "f" || keyword == "fo") {
      while (!rest.empty()) {
        const std::string_view word = TakeWord(&rest);
        if (word.empty()) break;
        soup.corners.push_back(ReadCorner(word, soup.vertices.size(), text));
      }
      soup.EndPolygon();
    }
  }
  return soup;
}

}  // namespace antigrasp
