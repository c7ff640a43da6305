#pragma once

namespace antigrasp {

struct Point2 {
  double x, y;
};

// The exact sign of (b - a) x (c - a): +1 when a, b, c turn left, 0 when they are collinear. A fast
// error bound decides almost always, an exact expansion the rest (Shewchuk, "Adaptive precision
// floating-point arithmetic", 1997).
int Orient2dSign(const Point2& a, const Point2& b, const Point2& c);

// The same for c moved by (epsilon, epsilon^2), epsilon infinitely small (simulation of
// simplicity): 0 only when a = b. Consistent over all edges, so a crossing count never sees a ray
// hit an edge or a vertex.
int Orient2dSignPerturbed(const Point2& a, const Point2& b, const Point2& c);

}  // namespace antigrasp
