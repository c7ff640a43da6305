#include "antigrasp/models/winograd_conv.h"

#include "antigrasp/core/pieces.h"
#include "antigrasp/models/winograd_sums.h"
#include "antigrasp/models/winograd_tiles.h"
#include "antigrasp/models/winograd_weights.h"

// Compiled for AVX2 and FMA, like all of Winograd's convolution but its products.
namespace antigrasp {
namespace winograd {
namespace {

constexpr std::int64_t kDepth = 128;    // of products summed at a time: a panel's rows stay in L1
constexpr std::int64_t kColumns = 128;  // cells' channels made at a time

// A piece of a call: the layer and the buffers.
class Convolution {
 public:
  Convolution(const CellConvShape& shape, const Panels& panels, std::int64_t depth,
              std::int64_t width)
      : s_(shape),
        cell_(StepsOf(shape.h, shape.in)),
        output_(StepsOf(shape.h - 1, shape.out)),
        panels_(panels),
        value_step_(kTiles * depth + kPadding),
        product_step_(kTiles * width + kPadding),
        values_(AllocateFloats(9 * value_step_)),
        products_(AllocateFloats(9 * product_step_)) {}

  // Channels [column, column + width) of the outputs.
  template <int Z>
  void FillOutputs(const TileBlock& block, std::int64_t column, std::int64_t width,
                   const float* cells, const float* bias, float* outputs) {
    const float* panels = panels_.values.get() + 9 * Z * panels_.step + column * s_.in;
    for (std::int64_t first = 0; first < s_.in; first += kDepth) {
      const std::int64_t depth = std::min(kDepth, s_.in - first);
      for (std::int64_t r = 0; r < block.rows; ++r) {
        DifferenceCells<Z>(cells + block.cells[r] + first, cell_, depth, values_.get() + r * kDepth,
                           value_step_);
      }
      for (int k = 0; k < 9; ++k) {
        add_products_({.rows = block.rows,
                       .depth = depth,
                       .width = width,
                       .left = values_.get() + k * value_step_,
                       .left_row_step = kDepth,
                       .left_depth_step = 1,
                       .right = panels + k * panels_.step + first * kPanel,
                       .right_panel_step = s_.in * kPanel,
                       .sums = products_.get() + k * product_step_,
                       .sums_row_step = width,
                       .sums_panel_step = kPanel,
                       .first = first == 0});
      }
    }
    for (std::int64_t r = 0; r < block.count; ++r) {
      AddToOutputs<Z>(products_.get() + r * width, product_step_, width,
                      bias != nullptr ? bias + column : nullptr, output_,
                      outputs + block.outputs[r] + column);
    }
  }

  // Channels [first, first + width) of the cells.
  template <int Z>
  void FillCells(const TileBlock& block, std::int64_t first, std::int64_t width,
                 const float* outputs, float* cells) {
    for (std::int64_t r = 0; r < block.rows; ++r) {
      SpreadOutputs<Z>(outputs + block.outputs[r], output_, s_.out, values_.get() + r * s_.out,
                       value_step_);
    }
    for (int k = 0; k < 9; ++k) {
      add_products_({.rows = block.rows,
                     .depth = s_.out,
                     .width = width,
                     .left = values_.get() + k * value_step_,
                     .left_row_step = s_.out,
                     .left_depth_step = 1,
                     .right = panels_.values.get() + (9 * Z + k) * panels_.step + first * s_.out,
                     .right_panel_step = s_.out * kPanel,
                     .sums = products_.get() + k * product_step_,
                     .sums_row_step = kColumns,
                     .sums_panel_step = kPanel,
                     .first = true});
    }
    for (std::int64_t r = 0; r < block.count; ++r) {
      AddToCells<Z>(products_.get() + r * kColumns, product_step_, width, cell_,
                    cells + block.cells[r] + first);
    }
  }

 private:
  const ProductKernel add_products_ = BestProductKernel();
  CellConvShape s_;
  Steps cell_, output_;
  const Panels& panels_;
  std::int64_t value_step_, product_step_;
  Floats values_, products_;  // of the nine values of a plane
};

// How a call is cut: tiles and channels of a piece. No number depends on it, so that it may depend
// on the threads: one thread does best with as much as its caches hold.
struct Cut {
  std::int64_t tiles, columns;
};

constexpr std::int64_t kPiecesAThread = 4, kLeastColumns = 2 * kPanel, kLeastTiles = 32;

Cut CutOf(std::int64_t tiles, std::int64_t columns, Cut cut) {
  const std::int64_t wanted = PieceThreads() > 1 ? kPiecesAThread * PieceThreads() : 1;
  const auto pieces = [&] {
    return ((tiles + cut.tiles - 1) / cut.tiles) * ((columns + cut.columns - 1) / cut.columns);
  };
  while (pieces() < wanted && cut.columns % (2 * kLeastColumns) == 0) cut.columns /= 2;
  while (pieces() < wanted && cut.tiles > kLeastTiles) cut.tiles /= 2;
  return cut;
}

// Outputs of `tiles` tiles from the first, channels [column, column + width).
void FillTiles(const CellConvShape& s, const Panels& panels, std::int64_t first, std::int64_t tiles,
               std::int64_t column, std::int64_t width, const float* cells, const float* bias,
               float* outputs) {
  Convolution convolution(s, panels, kDepth, width);
  for (std::int64_t i = first; i < first + tiles; i += kTiles) {
    const TileBlock block(s, i, std::min(kTiles, first + tiles - i));
    convolution.FillOutputs<0>(block, column, width, cells, bias, outputs);
    convolution.FillOutputs<1>(block, column, width, cells, bias, outputs);
    convolution.FillOutputs<2>(block, column, width, cells, bias, outputs);
  }
}

// Channels [column, column + width) of the cells of `tiles` tiles from the first, all of some
// samples: tiles share cells, and come in an order that does not depend on the samples around.
void FillCellsOfTiles(const CellConvShape& s, const Panels& panels, std::int64_t first,
                      std::int64_t tiles, std::int64_t column, std::int64_t width,
                      const float* outputs, float* cells) {
  Convolution convolution(s, panels, s.out, kColumns);
  for (std::int64_t i = first; i < first + tiles; i += kTiles) {
    const TileBlock block(s, i, std::min(kTiles, first + tiles - i));
    for (std::int64_t c = column; c < column + width; c += kColumns) {
      const std::int64_t some = std::min(kColumns, column + width - c);
      convolution.FillCells<0>(block, c, some, outputs, cells);
      convolution.FillCells<1>(block, c, some, outputs, cells);
      convolution.FillCells<2>(block, c, some, outputs, cells);
    }
  }
}

std::int64_t TilesOf(const CellConvShape& s) {
  const std::int64_t t = (s.h - 1) / 2;
  return t * t * t;
}
std::int64_t CellsOf(const CellConvShape& s) { return s.h * s.h * s.h; }

// Samples whose tiles fill a block.
std::int64_t GroupOf(const CellConvShape& s) {
  return std::max<std::int64_t>(1, kTiles / TilesOf(s));
}

constexpr std::int64_t kGroupFloats = 1 << 18;  // half of a core's cache beside the panels

}  // namespace
}  // namespace winograd

void WinogradConv(const CellConvShape& s, const float* cells, const float* weight,
                  const float* bias, float* outputs) {
  using namespace winograd;
  const Panels panels = MakePanels(s, weight, true);
  const std::int64_t tiles = s.count * TilesOf(s);
  const Cut cut = CutOf(tiles, s.out, {kTiles, s.out});
  const std::int64_t blocks = (tiles + cut.tiles - 1) / cut.tiles;
  const std::int64_t parts = (s.out + cut.columns - 1) / cut.columns;
  // An output's sum does not depend on the tiles of its block: the same bits for any threads.
  ForPieces(blocks * parts, [&](std::int64_t i) {
    const std::int64_t first = i / parts * cut.tiles, c = i % parts * cut.columns;
    FillTiles(s, panels, first, std::min(cut.tiles, tiles - first), c,
              std::min(cut.columns, s.out - c), cells, bias, outputs);
  });
}

void WinogradConvTranspose(const CellConvShape& s, const float* outputs, const float* weight,
                           float* cells) {
  using namespace winograd;
  const Panels panels = MakePanels(s, weight, false);
  const std::int64_t tiles = TilesOf(s);
  const Cut cut = CutOf(s.count * tiles, s.in, {std::max(kTiles, tiles), kColumns});
  const std::int64_t group = std::max<std::int64_t>(1, cut.tiles / tiles);
  const std::int64_t groups = (s.count + group - 1) / group;
  const std::int64_t parts = (s.in + cut.columns - 1) / cut.columns;
  ForPieces(groups * parts, [&](std::int64_t i) {
    const std::int64_t sample = i / parts * group, next = std::min(s.count, sample + group);
    const std::int64_t c = i % parts * cut.columns, width = std::min(cut.columns, s.in - c);
    for (std::int64_t cell = sample * CellsOf(s); cell < next * CellsOf(s); ++cell) {
      std::fill_n(cells + cell * s.in + c, width, 0.0F);
    }
    FillCellsOfTiles(s, panels, sample * tiles, (next - sample) * tiles, c, width, outputs, cells);
  });
}

bool SuitsSampleBySample(const CellConvShape& s) {
  using namespace winograd;
  return SuitsWinograd(s) && GroupOf(s) * CellsOf(s) * s.in <= kGroupFloats &&
         s.count >= 2 * GroupOf(s) * PieceThreads();
}

void WinogradConvOfFilled(const CellConvShape& s, const std::function<void(std::int64_t)>& fill,
                          const float* cells, const float* weight, const float* bias,
                          float* outputs) {
  using namespace winograd;
  const Panels panels = MakePanels(s, weight, true);
  ForRanges(s.count, GroupOf(s), [&](std::int64_t begin, std::int64_t end) {
    for (std::int64_t i = begin; i < end; ++i) fill(i);
    FillTiles(s, panels, begin * TilesOf(s), (end - begin) * TilesOf(s), 0, s.out, cells, bias,
              outputs);
  });
}

void WinogradConvTransposeTaken(const CellConvShape& s, const float* outputs, const float* weight,
                                const std::function<void(std::int64_t, const float*)>& take) {
  using namespace winograd;
  const Panels panels = MakePanels(s, weight, false);
  const std::int64_t g = s.h - 1, sample_size = CellsOf(s) * s.in;
  ForRanges(s.count, GroupOf(s), [&](std::int64_t begin, std::int64_t end) {
    const std::int64_t size = (end - begin) * sample_size;
    const Floats cells = AllocateFloats(size);
    std::fill_n(cells.get(), size, 0.0F);
    FillCellsOfTiles(s, panels, 0, (end - begin) * TilesOf(s), 0, s.in,
                     outputs + begin * g * g * g * s.out, cells.get());
    for (std::int64_t i = begin; i < end; ++i) take(i, cells.get() + (i - begin) * sample_size);
  });
}

}  // namespace antigrasp
