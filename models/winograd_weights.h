#pragma once

#include "antigrasp/models/winograd_tiles.h"

// The weights of a layer, [out][in / 8][4^3], to the factors of the products and back: of the taps
// of each phase (g0, g0 + g1, g1) along each axis.
namespace antigrasp::winograd {

// [27][columns / 16][rows][16 columns]; the columns are the layer's outputs and the rows its inputs
// (cells' channels), or the other way round.
struct Panels {
  Floats values;
  std::int64_t step;  // floats from one of the 27 to the next
};
Panels MakePanels(const CellConvShape& shape, const float* weight, bool of_outputs);

// Inputs whose gradients are summed together: phases 4 pz to 4 pz + 3 of the `width` channels from
// `first`, row (p % 4) * width + channel - first.
struct InputBlock {
  std::int64_t pz, first, width;
};

// sums [27][out / 16][4 width][16], the 27 `step` floats apart: gradients of the factors to
// gradients of the weights of the block.
void GatherWeightGradient(const CellConvShape& shape, const InputBlock& block, const float* sums,
                          std::int64_t step, float* weight_gradient);

}  // namespace antigrasp::winograd
