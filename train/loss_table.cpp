#include "antigrasp/train/loss_table.h"

#include <algorithm>

#include "antigrasp/core/csv_reader.h"
#include "antigrasp/core/csv_writer.h"
#include "antigrasp/core/error.h"

namespace antigrasp {
namespace {

constexpr const char* kStep = "step";

}  // namespace

LossRow RowOf(std::int64_t step, const std::vector<double>& scalars) {
  LossRow row = {double(step)};
  row.insert(row.end(), scalars.begin(), scalars.end());
  return row;
}

std::string LossesCsv(const LossTable& losses) {
  std::vector<std::string> columns = {kStep};
  columns.insert(columns.end(), losses.scalars.begin(), losses.scalars.end());
  CsvWriter csv(columns);
  for (const LossRow& row : losses.rows) {
    for (const double value : row) csv.NumberOrGap(value);
    csv.EndRow();
  }
  return csv.text();
}

LossTable ReadLosses(const std::filesystem::path& path) {
  CsvReader csv(path);
  const std::size_t step = csv.RequiredColumn(kStep);
  LossTable losses;
  losses.scalars = csv.names();
  losses.scalars.erase(losses.scalars.begin() + static_cast<std::ptrdiff_t>(step));
  while (csv.Next()) {
    LossRow row = {csv.NumberOrGap(step)};
    for (std::size_t c = 0; c < csv.names().size(); ++c) {
      if (c != step) row.push_back(csv.NumberOrGap(c));
    }
    losses.rows.push_back(std::move(row));
  }
  return losses;
}

torch::Tensor LossTensor(const LossTable& losses) {
  torch::Tensor tensor =
      torch::zeros({std::ssize(losses.rows), std::ssize(losses.scalars) + 1}, torch::kDouble);
  double* out = tensor.data_ptr<double>();
  for (const LossRow& row : losses.rows) out = std::copy(row.begin(), row.end(), out);
  return tensor;
}

std::vector<LossRow> LossRows(const torch::Tensor& tensor, std::size_t scalars,
                              const std::string& origin) {
  const auto columns = static_cast<std::int64_t>(scalars) + 1;
  if (tensor.dim() != 2 || tensor.size(1) != columns || tensor.scalar_type() != torch::kDouble) {
    throw InputError("losses of another shape", origin, "a checkpoint of this version");
  }
  const torch::Tensor losses = tensor.contiguous();
  const double* row = losses.data_ptr<double>();
  std::vector<LossRow> rows;
  for (std::int64_t i = 0; i < losses.size(0); ++i, row += columns) {
    rows.emplace_back(row, row + columns);
  }
  return rows;
}

}  // namespace antigrasp
