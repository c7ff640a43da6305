#include "tests/app/svg_text.h"

#include <cstdlib>
#include <map>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/report/figures/canvas.h"
#include "tests/support/temp_folder.h"

namespace antigrasp::cli {
namespace {

using Glyphs = std::vector<std::string>;

// What stands between `begin`, from `at` on, and `end`; moves `at` behind it. "" when there is
// none.
std::string Between(const std::string& text, const std::string& begin, const std::string& end,
                    std::size_t* at) {
  const std::size_t found = text.find(begin, *at);
  if (found == std::string::npos) {
    *at = text.size();
    return "";
  }
  const std::size_t first = found + begin.size(), last = text.find(end, first);
  *at = last;
  return text.substr(first, last - first);
}

// The outlines of every text, letter by letter.
std::vector<Glyphs> OutlinesIn(const std::string& svg) {
  std::map<std::string, std::string> outlines;  // by the name of the glyph
  std::size_t at = 0;
  const std::size_t drawing = svg.find("</defs>");
  while (true) {
    const std::string name = Between(svg, "<symbol overflow=\"visible\" id=\"", "\"", &at);
    if (at >= drawing) break;
    outlines[name] = Between(svg, " d=\"", "\"", &at);
  }
  std::vector<Glyphs> texts;
  at = drawing;
  while (true) {
    const std::string group = Between(svg, "<g style=\"fill:", "</g>", &at);
    if (at >= svg.size()) return texts;
    Glyphs glyphs;
    for (std::size_t k = 0; k < group.size();) {
      const std::string name = Between(group, "<use xlink:href=\"#", "\"", &k);
      if (outlines.contains(name)) glyphs.push_back(outlines[name]);
    }
    if (!glyphs.empty()) texts.push_back(glyphs);
  }
}

const std::vector<std::string>& Letters() {
  static const std::vector<std::string> letters = [] {
    std::vector<std::string> all = {"\u03ba", "\u2212", "\u00b0"};
    for (char c = ' '; c <= '~'; ++c) all.emplace_back(1, c);
    return all;
  }();
  return letters;
}

// Every letter in every style that a figure's text has.
std::map<std::string, std::string> Alphabet() {
  std::string line;
  for (const std::string& letter : Letters()) line += letter;
  std::vector<TextStyle> styles;
  for (const double size : {6.0, 6.5, 7.0, 7.5, 8.0, 8.5}) {
    for (const bool bold : {false, true}) {
      for (const bool upward : {false, true}) {
        styles.push_back({size, kInk, Align::kLeft, bold, upward});
      }
    }
  }
  const shapes::TempFolder folder;
  WritePage(folder / "letters.svg", {2000.0, 2000.0}, [&](Canvas* canvas) {
    double x = 100.0;
    for (const TextStyle& style : styles) canvas->Text(line, {x += 30.0, 1000.0}, style);
  });
  std::map<std::string, std::string> alphabet;
  for (const Glyphs& text : OutlinesIn(ReadFile(folder / "letters.svg"))) {
    for (std::size_t k = 0; k < text.size(); ++k) alphabet.emplace(text[k], Letters().at(k));
  }
  return alphabet;
}

}  // namespace

std::vector<std::string> TextsIn(const std::string& svg) {
  static const std::map<std::string, std::string> alphabet = Alphabet();
  std::vector<std::string> texts;
  for (const Glyphs& glyphs : OutlinesIn(svg)) {
    std::string text;
    for (const std::string& outline : glyphs) {
      text += alphabet.contains(outline) ? alphabet.at(outline) : "?";
    }
    texts.push_back(text);
  }
  return texts;
}

std::vector<double> DashedLinesIn(const std::string& svg, const std::string& dashes) {
  std::vector<double> places;
  std::size_t at = 0;
  while (true) {
    Between(svg, "stroke-dasharray:" + dashes + ";", "\"", &at);
    if (at >= svg.size()) return places;
    places.push_back(std::atof(Between(svg, " d=\"M ", " ", &at).c_str()));
  }
}

}  // namespace antigrasp::cli
