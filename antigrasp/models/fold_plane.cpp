#include "antigrasp/models/fold_plane.h"

#include <algorithm>
#include <array>
#include <vector>

namespace antigrasp {
namespace {

constexpr int kCells = 17;          // cells along a side of the folded 32^3 grid
constexpr int kSide = 2 * kCells;   // its nodes, ring included
constexpr int kPadded = kSide + 2;  // with a frame of zeros around them
constexpr int kVolume = kPadded * kPadded * kPadded;

// Offset of the row of cells that holds the nodes with px = 0 of grid row (z, y); those with px = 1
// are one plane further.
int RowOffset(int z, int y, int h) {
  const int plane = 4 * ((z + 1) % 2) + 2 * ((y + 1) % 2);
  return ((plane * h + (z + 1) / 2) * h + (y + 1) / 2) * h;
}

// Calls visit(row of the framed grid at x = -1, cells px = 0, cells px = 1) for all 34^2 rows.
template <typename Folded, typename Framed, typename Visit>
void ForFramedRows(Folded* folded, Framed* framed, const Visit& visit) {
  for (int z = -1; z < kSide - 1; ++z) {
    for (int y = -1; y < kSide - 1; ++y) {
      Folded* cells = folded + RowOffset(z, y, kCells);
      visit(framed + ((z + 2) * kPadded + y + 2) * kPadded + 1, cells,
            cells + kCells * kCells * kCells);
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

void FoldPlane(const float* grid, int s, float* folded) {
  const int h = s / 2 + 1, volume = h * h * h;
  std::fill(folded, folded + 8 * volume, 0.0F);
  for (int z = 0; z < s; ++z) {
    for (int y = 0; y < s; ++y, grid += s) {
      float* even = folded + RowOffset(z, y, h);
      float* odd = even + volume;
      for (int i = 0; i < s / 2; ++i) {
        odd[i] = grid[2 * i];
        even[i + 1] = grid[2 * i + 1];
      }
    }
  }
}

void UnfoldPlane(const float* folded, int s, float* grid) {
  const int h = s / 2 + 1, volume = h * h * h;
  for (int z = 0; z < s; ++z) {
    for (int y = 0; y < s; ++y, grid += s) {
      const float* even = folded + RowOffset(z, y, h);
      const float* odd = even + volume;
      for (int i = 0; i < s / 2; ++i) {
        grid[2 * i] = odd[i];
        grid[2 * i + 1] = even[i + 1];
      }
    }
  }
}

void BlurPlane(const float* folded, float* result) {
  std::vector<float> a(kVolume), b(kVolume);
  ForFramedRows(folded, a.data(), [](float* row, const float* even, const float* odd) {
    for (int i = 0; i < kCells; ++i) {
      row[2 * i] = even[i];
      row[2 * i + 1] = odd[i];
    }
  });
  BlurPass(a.data(), 1, b.data());
  BlurPass(b.data(), kPadded, a.data());
  BlurPass(a.data(), kPadded * kPadded, b.data());
  ForFramedRows(result, b.data(), [](const float* row, float* even, float* odd) {
    for (int i = 0; i < kCells; ++i) {
      even[i] = row[2 * i];
      odd[i] = row[2 * i + 1];
    }
  });
}

void ClearRing(float* folded) {
  for (int plane = 0; plane < 8; ++plane, folded += kCells * kCells * kCells) {
    // Phase 0 of the first cell is node -1, phase 1 of the last is node 32.
    const std::array<int, 3> ring = {plane & 4 ? kCells - 1 : 0, plane & 2 ? kCells - 1 : 0,
                                     plane & 1 ? kCells - 1 : 0};
    for (int i = 0; i < kCells; ++i) {
      for (int j = 0; j < kCells; ++j) {
        folded[(ring[0] * kCells + i) * kCells + j] = 0.0F;
        folded[(i * kCells + ring[1]) * kCells + j] = 0.0F;
        folded[(i * kCells + j) * kCells + ring[2]] = 0.0F;
      }
    }
  }
}

}  // namespace antigrasp
