#pragma once

namespace antigrasp {

// The memory moves behind folding.h on the CPU, where general strided copies of tensors take longer
// than the convolutions they feed. Channels lie side by side.

// grid: s^3 nodes of c values, s even; cells: h^3 cells of 8 c values, h = s / 2 + 1, the eight
// nodes of a cell one after another, number 4 pz + 2 py + px. Node g of an axis is the phase
// p = (g + 1) % 2 of cell (g + 1) / 2.
void FoldNodes(const float* grid, int s, int c, float* cells);    // nodes -1 and s are zero
void UnfoldCells(const float* cells, int s, int c, float* grid);  // drops them

// The same of values that are multiplied by `leak` where they are not above zero; and the
// way back of the gradient of those cells, `slopes`.
void FoldLeakyNodes(const float* grid, int s, int c, float leak, float* cells);
void UnfoldLeakySlopes(const float* slopes, const float* cells, int s, int c, float leak,
                       float* grid);

// cells, c = 1: smooths the (s + 2)^3 nodes, ring included, with [1 2 1]/4 along each axis, values
// beyond being zero. A symmetric matrix. May work in place.
void BlurCells(const float* cells, int s, float* result);
void ClearRing(int s, float* cells);  // zeroes the ring, c = 1

// cells, c = 1: x - gain * Laplacian(x) of the s^3 nodes, a grid that ends (no slope across its
// border); the ring is zero. A symmetric matrix. May work in place.
void EmphasizeNodes(const float* cells, int s, float gain, float* result);

}  // namespace antigrasp
