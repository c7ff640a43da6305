#include "antigrasp/models/winograd_conv.h"

#include <ATen/Parallel.h>

#include "antigrasp/models/winograd_sums.h"
#include "antigrasp/models/winograd_tiles.h"
#include "antigrasp/models/winograd_weights.h"

// Compiled for AVX2 and FMA, like all of Winograd's convolution but its products.
namespace antigrasp {
namespace winograd {
namespace {

constexpr std::int64_t kDepth = 128;    // of products summed at a time: a panel's rows stay in L1
constexpr std::int64_t kColumns = 128;  // cells' channels made at a time

// One call: the layer and the buffers of one thread.
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

  template <int Z>
  void FillOutputs(const TileBlock& block, const float* cells, const float* bias, float* outputs) {
    for (std::int64_t first = 0; first < s_.in; first += kDepth) {
      const std::int64_t depth = std::min(kDepth, s_.in - first);
      for (std::int64_t r = 0; r < block.rows; ++r) {
        DifferenceCells<Z>(cells + block.cells[r] + first, cell_, depth, values_.get() + r * kDepth,
                           value_step_);
      }
      for (int k = 0; k < 9; ++k) {
        add_products_({.rows = block.rows,
                       .depth = depth,
                       .width = s_.out,
                       .left = values_.get() + k * value_step_,
                       .left_row_step = kDepth,
                       .left_depth_step = 1,
                       .right = panels_.values.get() + (9 * Z + k) * panels_.step + first * kPanel,
                       .right_panel_step = s_.in * kPanel,
                       .sums = products_.get() + k * product_step_,
                       .sums_row_step = s_.out,
                       .sums_panel_step = kPanel,
                       .first = first == 0});
      }
    }
    for (std::int64_t r = 0; r < block.count; ++r) {
      AddToOutputs<Z>(products_.get() + r * s_.out, product_step_, s_.out, bias, output_,
                      outputs + block.outputs[r]);
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

}  // namespace
}  // namespace winograd

void WinogradConv(const CellConvShape& s, const float* cells, const float* weight,
                  const float* bias, float* outputs) {
  using namespace winograd;
  const Panels panels = MakePanels(s, weight, true);
  const std::int64_t t = (s.h - 1) / 2;
  // An output's sum does not depend on the tiles of its block: the same bits for any threads.
  at::parallel_for(0, s.count * t * t * t, 8, [&](std::int64_t begin, std::int64_t end) {
    Convolution convolution(s, panels, kDepth, s.out);
    for (std::int64_t first = begin; first < end; first += kTiles) {
      const TileBlock block(s, first, std::min(kTiles, end - first));
      convolution.FillOutputs<0>(block, cells, bias, outputs);
      convolution.FillOutputs<1>(block, cells, bias, outputs);
      convolution.FillOutputs<2>(block, cells, bias, outputs);
    }
  });
}

void WinogradConvTranspose(const CellConvShape& s, const float* outputs, const float* weight,
                           float* cells) {
  using namespace winograd;
  const Panels panels = MakePanels(s, weight, false);
  const std::int64_t t = (s.h - 1) / 2, tiles = t * t * t, sample_size = s.h * s.h * s.h * s.in;
  // Tiles share cells: a sample belongs to one thread, and its tiles come in an order that does not
  // depend on the samples around it.
  const std::int64_t group = std::max<std::int64_t>(1, kTiles / tiles);
  at::parallel_for(0, s.count, 1, [&](std::int64_t begin, std::int64_t end) {
    Convolution convolution(s, panels, s.out, kColumns);
    for (std::int64_t sample = begin; sample < end; sample += group) {
      const std::int64_t next = std::min(end, sample + group);
      std::fill(cells + sample * sample_size, cells + next * sample_size, 0.0F);
      for (std::int64_t first = sample * tiles; first < next * tiles; first += kTiles) {
        const TileBlock block(s, first, std::min(kTiles, next * tiles - first));
        for (std::int64_t c = 0; c < s.in; c += kColumns) {
          const std::int64_t width = std::min(kColumns, s.in - c);
          convolution.FillCells<0>(block, c, width, outputs, cells);
          convolution.FillCells<1>(block, c, width, outputs, cells);
          convolution.FillCells<2>(block, c, width, outputs, cells);
        }
      }
    }
  });
}

}  // namespace antigrasp
