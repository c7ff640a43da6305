#pragma once

#include "antigrasp/models/model_options.h"

namespace antigrasp::bench {

// Floating-point operations (2 for each multiply-add) of the linear layers and convolutions of one
// update of D and one of G on batches of `batch`, with the 4^3 kernels as written and with one
// forward of G: what a step cannot do without. D's gradients for its own input in its update, and
// for its weights in G's, are not needed and not counted; nor is anything that is not a product
// with a weight.
inline double StepOperations(const ModelOptions& options, double batch) {
  const double c = options.width, taps = 64.0;
  // Multiply-adds of a shape, layer by layer from 2^3 to 32^3. D mirrors G but for the packs,
  // which put `pack` channels on the grid of one sample of `pack` shapes.
  const double project = options.latent * 8 * c * 8;
  const double hidden = taps * (8 * 8 * c * 4 * c + 64 * 4 * c * 2 * c + 512 * 2 * c * c);
  const double grid = taps * 4096 * c;
  const double head = 8 * c * 8;
  const double generator = 3 * (hidden + grid) + 2 * project;  // forward, both gradients
  const double samples = 1.0 / options.pack;                   // of D for each shape
  const double inner = samples * (hidden + head), first = grid;
  const double update_d = 2 * (3 * inner + 2 * first);  // real and generated
  const double update_g = 2 * (inner + first);          // forward, gradient of the input
  return 2 * batch * (generator + update_d + update_g);
}

// The same of drawing: one forward of G.
inline double SampleOperations(const ModelOptions& options, double grids) {
  const double c = options.width, taps = 64.0;
  const double hidden = taps * (8 * 8 * c * 4 * c + 64 * 4 * c * 2 * c + 512 * 2 * c * c);
  return 2 * grids * (options.latent * 8 * c * 8 + hidden + taps * 4096 * c);
}

// Bytes of an update's layer outputs, float32, each written and read once forward and its gradient
// once backward: what goes to memory when no cache holds a layer of the batch.
inline double StepBytes(const ModelOptions& options, double batch) {
  const double c = options.width;
  const double layers = 8 * 8 * c + 64 * 4 * c + 512 * 2 * c + 4096 * c + 32768;  // of a shape
  const double passes = 1 + 2 + 1;  // G; D on real, on generated; D in G's update
  return 4.0 * 4 * passes * batch * layers;
}

}  // namespace antigrasp::bench
