#pragma once

#include <ATen/core/Tensor.h>

#include <cstdint>

namespace antigrasp {

// A part of a solid is a prism in a frame of its own: its section is a rectangle with rounded
// corners (a disc when they are as large as they can be), its walls may lean, its ends may have
// rounded edges. Boxes, cylinders, cones and what is between them, as a row of numbers, in units of
// the cube's side, whose centre is the origin:
enum PartColumn {
  kPartAxes = 0,    // 9: rows are the unit axes u, v, w
  kPartCentre = 9,  // 3: along u, v, w
  kPartHalf = 12,   // 3: half sizes along u, v (in the middle, w = 0) and w; > 0
  kPartRound = 15,  // radius of the section's corners, share of the smaller half size there: [0, 1]
  kPartLean = 16,   // 2: by how much the half sizes along u and v grow with w
  kPartFillet = 18,  // radius of the edges at both ends
  kPartNarrow = 19,  // from a distance along the section to one across a leaning wall: its cosine
  kPartColumns = 20,
};

inline constexpr std::int64_t kMostParts = 32;

// Distances to the union of parts, positive inside: parts [N, M, kPartColumns] -> [N, 1, r, r, r]
// at the nodes of a cube of side 1, cells' middles, x fastest. A union takes the largest, so that
// beside a face the values are those of its plane (cylinder, cone) alone, and marching cubes gives
// it back flat. With upright walls exact outside and for a single part; inside of several never
// more than the true distance. Differentiable once in the parts. Float on the CPU goes in one pass
// over memory, with the same bits for any number of threads and any CPU; all else through the
// operations of LibTorch. 0 < M <= kMostParts, r a multiple of 16.
at::Tensor SolidField(const at::Tensor& parts, std::int64_t resolution);

// The same by the operations of LibTorch, in any type, on any device.
at::Tensor SolidFieldByOperations(const at::Tensor& parts, std::int64_t resolution);

}  // namespace antigrasp
