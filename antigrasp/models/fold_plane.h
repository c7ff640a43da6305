#pragma once

namespace antigrasp {

// The memory moves behind folding.h for one channel on the CPU, where general strided copies of
// tensors take five times as long as the convolutions they feed.

// grid: s^3 values, s even; folded: 8 planes of h^3 values, h = s / 2 + 1, plane 4 pz + 2 py + px.
// Node g of an axis is the phase p = (g + 1) % 2 of cell (g + 1) / 2.
void FoldPlane(const float* grid, int s, float* folded);    // the ring of nodes -1 and s is zero
void UnfoldPlane(const float* folded, int s, float* grid);  // drops the ring

// folded, s = 32: smooths the 34^3 nodes, ring included, with [1 2 1]/4 along each axis, values
// beyond being zero. A symmetric matrix. May work in place.
void BlurPlane(const float* folded, float* result);
void ClearRing(float* folded);  // zeroes the ring, s = 32

}  // namespace antigrasp
