#pragma once

#include <torch/types.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace antigrasp {

// A row of episode_K/losses.csv: the step within the episode, then the model's scalars.
using LossRow = std::vector<double>;
LossRow RowOf(std::int64_t step, const std::vector<double>& scalars);

struct LossTable {
  std::vector<std::string> scalars;  // their names, as the model gives them
  std::vector<LossRow> rows;
};

// losses.csv (docs/formats.md) and back; a NaN is an empty field. InputError with file:line.
std::string LossesCsv(const LossTable& losses);
LossTable ReadLosses(const std::filesystem::path& path);

// The rows as a checkpoint keeps them, float64 [rows, 1 + scalars], and back: InputError naming
// `origin` for those of a model with another number of scalars.
torch::Tensor LossTensor(const LossTable& losses);
std::vector<LossRow> LossRows(const torch::Tensor& tensor, std::size_t scalars,
                              const std::string& origin);

}  // namespace antigrasp
