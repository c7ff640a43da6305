#pragma once

#include <torch/serialize/archive.h>
#include <torch/types.h>

#include <filesystem>
#include <functional>
#include <string>

namespace antigrasp {

// The state of a run in one file: a LibTorch archive (a zip that torch.jit.load also opens) whose
// layout is in docs/formats.md. Equal states give equal bytes.
struct Checkpoint {
  static constexpr int kVersion = 1;

  std::string config;      // the resolved configuration, TOML
  std::string statistics;  // finished stages, CSV (train/statistics.h)
  torch::Tensor shapes;    // training set of the current episode, float16 [N, 1, r, r, r]
  torch::Tensor losses;    // of the current episode, float64 [rows, columns of losses.csv]
  bool finished = false;   // the last stage has been scored
};

using SaveNetworks = std::function<void(torch::serialize::OutputArchive*)>;
using LoadNetworks = std::function<void(torch::serialize::InputArchive*)>;

// Atomic: the previous file stays whole until the new one is on disk. RuntimeFailure on a full
// disk.
void WriteCheckpoint(const std::filesystem::path& path, const Checkpoint& checkpoint,
                     const SaveNetworks& save_networks);

// Reads everything but the networks, then hands their archive to `load_networks` (may be null).
// InputError for a missing, foreign or truncated file and for another version.
Checkpoint ReadCheckpoint(const std::filesystem::path& path);
void ReadNetworks(const std::filesystem::path& path, const LoadNetworks& load_networks);

// By content, never throws.
bool IsCheckpoint(const std::filesystem::path& path);

}  // namespace antigrasp
