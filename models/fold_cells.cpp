#include "antigrasp/models/fold_cells.h"

#include <algorithm>
#include <cstring>
#include <type_traits>
#include <vector>

namespace antigrasp {
namespace {

// Offset of the nodes of grid row (z, y) in its first cell, phases px = 0 and 1 side by side.
int RowOffset(int z, int y, int h, int c) {
  const int phase = 4 * ((z + 1) % 2) + 2 * ((y + 1) % 2);
  return ((((z + 1) / 2) * h + (y + 1) / 2) * h * 8 + phase) * c;
}

// Nodes along a side of the grid with its ring and a frame of zeros around that.
int FramedSide(int h) { return 2 * h + 2; }

// Calls visit(row of the framed grid at x = -1, its two nodes in the row's first cell) for all
// rows; the next cell's are 8 values on.
template <typename Cells, typename Framed, typename Visit>
void ForFramedRows(int h, Cells* cells, Framed* framed, const Visit& visit) {
  const int side = FramedSide(h);
  for (int z = -1; z < 2 * h - 1; ++z) {
    for (int y = -1; y < 2 * h - 1; ++y) {
      visit(framed + ((z + 2) * side + y + 2) * side + 1, cells + RowOffset(z, y, h, 1));
    }
  }
}

// dst = [1 2 1]/4 of src along the axis of this stride, over the whole frame at once. The frame's
// own values go wrong along that axis, and no later pass along another axis reads them.
void BlurPass(const float* src, int volume, int stride, float* dst) {
  for (int i = stride; i < volume - stride; ++i) {
    dst[i] = 0.5F * src[i] + 0.25F * (src[i - stride] + src[i + stride]);
  }
}

// Runs of a length that the compiler knows are copied without a call. Number of channels, 0: any.
template <typename Run>
void WithChannels(int c, const Run& run) {
  switch (c) {
    case 1:
      return run(std::integral_constant<int, 1>());
    case 8:
      return run(std::integral_constant<int, 8>());
    case 16:
      return run(std::integral_constant<int, 16>());
    default:
      return run(std::integral_constant<int, 0>());
  }
}

// By vectors that the compiler would not see, since comparisons may trap: half of all values would
// mispredict a branch.
typedef float Four __attribute__((vector_size(16)));
inline Four LoadFour(const float* from) {
  Four values;
  std::memcpy(&values, from, sizeof(values));
  return values;
}

// to = slopes where `values` are above zero, slopes * leak elsewhere.
inline void Leak(const float* slopes, const float* values, int count, float leak, float* to) {
  int i = 0;
  for (; i + 4 <= count; i += 4) {
    const Four slope = LoadFour(slopes + i);
    const Four leaked = LoadFour(values + i) > 0.0F ? slope : slope * leak;
    std::memcpy(to + i, &leaked, sizeof(leaked));
  }
  for (; i < count; ++i) to[i] = values[i] > 0.0F ? slopes[i] : slopes[i] * leak;
}

template <int kChannels>
void ClearRingNodes(int s, int any, float* cells) {
  const int c = kChannels > 0 ? kChannels : any, h = s / 2 + 1;
  const auto clear = [=](int z, int y, int x, int phase) {
    std::fill_n(cells + (((z * h + y) * h + x) * 8 + phase) * c, c, 0.0F);
  };
  for (int phase = 0; phase < 8; ++phase) {
    // Phase 0 of the first cell is node -1, phase 1 of the last is node s.
    const auto ring = [phase, h](int bit) { return (phase & bit) != 0 ? h - 1 : 0; };
    for (int i = 0; i < h; ++i) {
      for (int j = 0; j < h; ++j) {
        clear(ring(4), i, j, phase);
        clear(i, ring(2), j, phase);
        clear(i, j, ring(1), phase);
      }
    }
  }
}

// put(from, count, to) moves values of the grid.
template <int kChannels, typename Put>
void FoldRows(const float* grid, int s, int any, const Put& put, float* cells) {
  const int c = kChannels > 0 ? kChannels : any, h = s / 2 + 1, step = 8 * c;
  ClearRingNodes<kChannels>(s, c, cells);
  for (int z = 0; z < s; ++z) {
    for (int y = 0; y < s; ++y, grid += s * c) {
      float* row = cells + RowOffset(z, y, h, c);
      put(grid, c, row + c);             // node 0
      for (int i = 1; i < h - 1; ++i) {  // nodes 2 i - 1 and 2 i
        put(grid + (2 * i - 1) * c, 2 * c, row + i * step);
      }
      put(grid + (s - 1) * c, c, row + (h - 1) * step);
    }
  }
}

// put(place among all cells' values, count, to) moves values of cells.
template <int kChannels, typename Put>
void UnfoldRows(int s, int any, const Put& put, float* grid) {
  const int c = kChannels > 0 ? kChannels : any, h = s / 2 + 1, step = 8 * c;
  for (int z = 0; z < s; ++z) {
    for (int y = 0; y < s; ++y, grid += s * c) {
      const int row = RowOffset(z, y, h, c);
      put(row + c, c, grid);
      for (int i = 1; i < h - 1; ++i) put(row + i * step, 2 * c, grid + (2 * i - 1) * c);
      put(row + (h - 1) * step, c, grid + (s - 1) * c);
    }
  }
}

// row = x - gain * (the part of the Laplacian along one axis): to the neighbour above, then from
// the one below; nullptr beyond the grid.
void AddSlopes(const float* x, const float* above, const float* below, int s, float gain,
               float* row) {
  if (above != nullptr) {
    for (int i = 0; i < s; ++i) row[i] -= (above[i] - x[i]) * gain;
  }
  if (below != nullptr) {
    for (int i = 0; i < s; ++i) row[i] += (x[i] - below[i]) * gain;
  }
}

}  // namespace

void FoldNodes(const float* grid, int s, int c, float* cells) {
  const auto put = [](const float* from, int count, float* to) { std::copy_n(from, count, to); };
  WithChannels(c, [&](auto channels) { FoldRows<channels>(grid, s, c, put, cells); });
}

void FoldLeakyNodes(const float* grid, int s, int c, float leak, float* cells) {
  const auto put = [leak](const float* from, int count, float* to) {
    Leak(from, from, count, leak, to);
  };
  WithChannels(c, [&](auto channels) { FoldRows<channels>(grid, s, c, put, cells); });
}

void UnfoldCells(const float* cells, int s, int c, float* grid) {
  const auto put = [cells](int from, int count, float* to) {
    std::copy_n(cells + from, count, to);
  };
  WithChannels(c, [&](auto channels) { UnfoldRows<channels>(s, c, put, grid); });
}

void UnfoldLeakySlopes(const float* slopes, const float* cells, int s, int c, float leak,
                       float* grid) {
  const auto put = [=](int from, int count, float* to) {
    Leak(slopes + from, cells + from, count, leak, to);
  };
  WithChannels(c, [&](auto channels) { UnfoldRows<channels>(s, c, put, grid); });
}

void BlurCells(const float* cells, int s, float* result) {
  const int h = s / 2 + 1, side = FramedSide(h), volume = side * side * side;
  std::vector<float> a(static_cast<std::size_t>(volume)), b(a);
  ForFramedRows(h, cells, a.data(), [h](float* row, const float* nodes) {
    for (int i = 0; i < h; ++i) {
      row[2 * i] = nodes[8 * i];
      row[2 * i + 1] = nodes[8 * i + 1];
    }
  });
  BlurPass(a.data(), volume, 1, b.data());
  BlurPass(b.data(), volume, side, a.data());
  BlurPass(a.data(), volume, side * side, b.data());
  ForFramedRows(h, result, b.data(), [h](const float* row, float* nodes) {
    for (int i = 0; i < h; ++i) {
      nodes[8 * i] = row[2 * i];
      nodes[8 * i + 1] = row[2 * i + 1];
    }
  });
}

void ClearRing(int s, float* cells) { ClearRingNodes<1>(s, 1, cells); }

void EmphasizeNodes(const float* cells, int s, float gain, float* result) {
  const int plane = s * s;
  std::vector<float> nodes(static_cast<std::size_t>(s) * plane), sharp(nodes.size());
  UnfoldCells(cells, s, 1, nodes.data());
  const float* x = nodes.data();
  float* row = sharp.data();
  for (int z = 0; z < s; ++z) {
    for (int y = 0; y < s; ++y, x += s, row += s) {
      std::copy_n(x, s, row);
      AddSlopes(x, z + 1 < s ? x + plane : nullptr, z > 0 ? x - plane : nullptr, s, gain, row);
      AddSlopes(x, y + 1 < s ? x + s : nullptr, y > 0 ? x - s : nullptr, s, gain, row);
      AddSlopes(x, x + 1, nullptr, s - 1, gain, row);
      AddSlopes(x + 1, nullptr, x, s - 1, gain, row + 1);
    }
  }
  FoldNodes(sharp.data(), s, 1, result);
}

}  // namespace antigrasp
