#pragma once

#include <cstdint>

// The products of winograd_conv.h, of a block of tiles. Compiled for AVX2 and again for AVX-512;
// both take every sum in the same order and give the same bits.
namespace antigrasp::winograd {

constexpr std::int64_t kPanel = 16;   // columns that lie side by side
constexpr std::int64_t kRowStep = 4;  // rows come in multiples of this

// sums [rows][width] = (`first`) or += left [rows][depth] x right [depth][width], width in panels
// of 16: right [width / 16][depth][16]. All steps are in floats.
struct ProductBlock {
  std::int64_t rows, depth, width;
  const float* left;
  std::int64_t left_row_step, left_depth_step;
  const float* right;
  std::int64_t right_panel_step;
  float* sums;
  std::int64_t sums_row_step, sums_panel_step;
  bool first;
};

using ProductKernel = void (*)(const ProductBlock& block);
void AddProductsAvx2(const ProductBlock& block);
void AddProductsAvx512(const ProductBlock& block);
ProductKernel BestProductKernel();  // of this CPU, which has AVX2

}  // namespace antigrasp::winograd
