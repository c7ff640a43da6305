#pragma once

namespace antigrasp {

// Red, green, blue and opacity in [0, 1].
struct Color {
  double r = 0.0, g = 0.0, b = 0.0, a = 1.0;
  Color WithAlpha(double alpha) const { return {r, g, b, alpha}; }
};

// What the figures are drawn in. The two series differ in lightness, too: they survive a grey
// print.
inline constexpr Color kInk = {0.13, 0.14, 0.16};
inline constexpr Color kMuted = {0.42, 0.44, 0.48};
inline constexpr Color kHairline = {0.82, 0.83, 0.85};
inline constexpr Color kBars = {0.42, 0.61, 0.83};
inline constexpr Color kMark = {0.08, 0.29, 0.55};

// The paper's gradient of grasp axes: 0 = the least reliable, red; 1 = the most, green; linear
// between, through a dark yellow. Values outside are cut, NaN is grey.
Color ReliabilityColor(double share);

// A signed distance divided by the largest magnitude: -1 (outside) blue, 0 near white, 1 (inside)
// orange. Values outside are cut, NaN is grey.
Color SignedColor(double share);

// Of a series of lines in an order: 0 light blue, 1 dark blue. Values outside are cut, NaN is grey.
Color DegreeColor(double share);

}  // namespace antigrasp
