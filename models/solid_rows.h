#pragma once

#include <cstdint>

// The sums of solid_field.h over one grid. Compiled for several kinds of vectors, of which the
// CPU's best is taken; all give the same bits.
namespace antigrasp::solid {

inline constexpr std::int64_t kLanes = 16;  // nodes taken at once: rows are whole multiples

// Parts [count][kPartColumns] and the coordinates x[r] of the nodes along a side.
struct Solid {
  const float* parts;
  std::int64_t count;
  const float* x;
  std::int64_t r;
};

// values [r^3]: distances, positive inside; nearest [r^3]: the part that each is of, the first of
// equals.
void Union(const Solid& solid, float* values, std::uint8_t* nearest);

// Adds to gradient [count][kPartColumns] what follows from by_value [r^3].
void AddUnionGradient(const Solid& solid, const float* by_value, const std::uint8_t* nearest,
                      float* gradient);

}  // namespace antigrasp::solid
