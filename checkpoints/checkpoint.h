#pragma once

#include <torch/types.h>

#include <filesystem>
#include <string>

#include "antigrasp/models/named_tensors.h"

namespace antigrasp {

// The state of a run in one file: a LibTorch archive (a zip that torch.jit.load also opens) whose
// layout is in docs/formats.md. Equal states give equal bytes.
struct Checkpoint {
  static constexpr int kVersion = 1;

  std::string config;      // the resolved configuration, TOML
  std::string statistics;  // finished stages, CSV (train/statistics.h)
  torch::Tensor shapes;    // training set of the current episode, float16 [N, 1, r, r, r]
  torch::Tensor losses;    // of the current episode, float64 [rows, columns of losses.csv]
  NamedTensors networks;   // the shape model's state, on any device
  bool finished = false;   // the last stage has been scored
};

// Atomic: the previous file stays whole until the new one is on disk. RuntimeFailure on a full
// disk.
void WriteCheckpoint(const std::filesystem::path& path, const Checkpoint& checkpoint);

// InputError for a missing, foreign or truncated file and for another version.
Checkpoint ReadCheckpoint(const std::filesystem::path& path);

// By content, never throws.
bool IsCheckpoint(const std::filesystem::path& path);

}  // namespace antigrasp
