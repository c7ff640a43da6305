#include "antigrasp/models/fold_cells.h"

#include <algorithm>
#include <vector>

namespace antigrasp {
namespace {

constexpr int kCells = 17;          // cells along a side of the folded 32^3 grid
constexpr int kSide = 2 * kCells;   // its nodes, ring included
constexpr int kPadded = kSide + 2;  // with a frame of zeros around them
constexpr int kVolume = kPadded * kPadded * kPadded;

// Offset of the nodes of grid row (z, y) in its first cell, phases px = 0 and 1 side by side.
int RowOffset(int z, int y, int h, int c) {
  const int phase = 4 * ((z + 1) % 2) + 2 * ((y + 1) % 2);
  return ((((z + 1) / 2) * h + (y + 1) / 2) * h * 8 + phase) * c;
}

// Calls visit(row of the framed grid at x = -1, its two nodes in the row's first cell) for all 34^2
// rows; the next cell's are 8 values on.
template <typename Cells, typename Framed, typename Visit>
void ForFramedRows(Cells* cells, Framed* framed, const Visit& visit) {
  for (int z = -1; z < kSide - 1; ++z) {
    for (int y = -1; y < kSide - 1; ++y) {
      visit(framed + ((z + 2) * kPadded + y + 2) * kPadded + 1, cells + RowOffset(z, y, kCells, 1));
    }
  }
}

// dst = [1 2 1]/4 of src along the axis of this stride, over the whole frame at once. The frame's
// own values go wrong along that axis, and no later pass along another axis reads them.
void BlurPass(const float* src, int stride, float* dst) {
  for (int i = stride; i < kVolume - stride; ++i) {
    dst[i] = 0.5F * src[i] + 0.25F * (src[i - stride] + src[i + stride]);
  }
}

}  // namespace

void FoldNodes(const float* grid, int s, int c, float* cells) {
  const int h = s / 2 + 1, step = 8 * c;
  std::fill(cells, cells + h * h * h * step, 0.0F);
  for (int z = 0; z < s; ++z) {
    for (int y = 0; y < s; ++y, grid += s * c) {
      float* row = cells + RowOffset(z, y, h, c);
      std::copy(grid, grid + c, row + c);  // node 0
      for (int i = 1; i < h - 1; ++i) {    // nodes 2 i - 1 and 2 i
        std::copy(grid + (2 * i - 1) * c, grid + (2 * i + 1) * c, row + i * step);
      }
      std::copy(grid + (s - 1) * c, grid + s * c, row + (h - 1) * step);
    }
  }
}

void UnfoldCells(const float* cells, int s, int c, float* grid) {
  const int h = s / 2 + 1, step = 8 * c;
  for (int z = 0; z < s; ++z) {
    for (int y = 0; y < s; ++y, grid += s * c) {
      const float* row = cells + RowOffset(z, y, h, c);
      std::copy(row + c, row + 2 * c, grid);
      for (int i = 1; i < h - 1; ++i) {
        std::copy(row + i * step, row + i * step + 2 * c, grid + (2 * i - 1) * c);
      }
      std::copy(row + (h - 1) * step, row + (h - 1) * step + c, grid + (s - 1) * c);
    }
  }
}

void BlurCells(const float* cells, float* result) {
  std::vector<float> a(kVolume), b(kVolume);
  ForFramedRows(cells, a.data(), [](float* row, const float* nodes) {
    for (int i = 0; i < kCells; ++i) {
      row[2 * i] = nodes[8 * i];
      row[2 * i + 1] = nodes[8 * i + 1];
    }
  });
  BlurPass(a.data(), 1, b.data());
  BlurPass(b.data(), kPadded, a.data());
  BlurPass(a.data(), kPadded * kPadded, b.data());
  ForFramedRows(result, b.data(), [](const float* row, float* nodes) {
    for (int i = 0; i < kCells; ++i) {
      nodes[8 * i] = row[2 * i];
      nodes[8 * i + 1] = row[2 * i + 1];
    }
  });
}

void ClearRing(float* cells) {
  const auto clear = [cells](int z, int y, int x, int phase) {
    cells[((z * kCells + y) * kCells + x) * 8 + phase] = 0.0F;
  };
  for (int phase = 0; phase < 8; ++phase) {
    // Phase 0 of the first cell is node -1, phase 1 of the last is node 32.
    const auto ring = [phase](int bit) { return (phase & bit) != 0 ? kCells - 1 : 0; };
    for (int i = 0; i < kCells; ++i) {
      for (int j = 0; j < kCells; ++j) {
        clear(ring(4), i, j, phase);
        clear(i, ring(2), j, phase);
        clear(i, j, ring(1), phase);
      }
    }
  }
}

}  // namespace antigrasp
