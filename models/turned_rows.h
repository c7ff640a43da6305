#pragma once

#include <cstdint>

// The sums of turned_field.h over one grid. Compiled for several kinds of vectors, of which the
// CPU's best is taken; all give the same bits.
namespace antigrasp::turned {

// Points [count][2], rows (radius, z), and the coordinates x[r] of the nodes along a side.
struct Outline {
  const float* points;
  std::int64_t count;
  const float* x;
  std::int64_t r;
};

// Nodes of a layer that lie equally far from the axis are one place: h = r / 2 along either half of
// a side, so that h (h + 1) / 2 radii stand for r^2 nodes.
constexpr std::int64_t Radii(std::int64_t r) { return r / 2 * (r / 2 + 1) / 2; }

// distances [Radii(r)][r], z fastest, positive inside; nearest: the piece that each is of, from
// points i to i + 1, the first of equals.
void Distances(const Outline& outline, float* distances, std::int16_t* nearest);

// distances [Radii(r)][r] -> values [r^3], x fastest.
void Spread(const float* distances, std::int64_t r, float* values);

// Adds to gradient [count][2] what follows from by_value [r^3].
void AddGradient(const Outline& outline, const float* by_value, const float* distances,
                 const std::int16_t* nearest, float* gradient);

}  // namespace antigrasp::turned
