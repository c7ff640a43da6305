#pragma once

#include <string>
#include <vector>

// What a figure says: its texts are outlines, read back by comparing them with those of letters
// drawn alone.
namespace antigrasp::cli {

// The texts of an SVG that antigrasp drew, in the order of the file. Letters that no figure has are
// "?".
std::vector<std::string> TextsIn(const std::string& svg);

// Where the vertical lines of this dash pattern ("3,1.5") stand, in the order of the file.
std::vector<double> DashedLinesIn(const std::string& svg, const std::string& dashes);

}  // namespace antigrasp::cli
