#include "antigrasp/train/statistics_table.h"

#include <cmath>
#include <limits>
#include <string_view>
#include <type_traits>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/csv_reader.h"
#include "antigrasp/core/csv_writer.h"
#include "antigrasp/core/error.h"

namespace antigrasp {
namespace {

// The columns in their order: calls field(name, number) with every number of a row.
template <class Row, class Field>
void ForEachColumn(Row* row, const Field& field) {
  field("stage", row->stage);
  field("samples", row->samples);
  for (int i = 0; i < kNumRemeshStatuses; ++i) {
    field(Name(static_cast<RemeshStatus>(i)), row->by_status[static_cast<std::size_t>(i)]);
  }
  field("scored", row->scored);
  field("without_grasps", row->without_grasps);
  field("graspability", row->graspability.mean);
  field("half_width_95", row->graspability.half_width);
  field("count", row->graspability.count);
  field("elite_threshold", row->elite_threshold);
  field("coverage", row->coverage);
  field("nna", row->nna);
  field("duplicates", row->duplicates);
  field("diversity", row->diversity);
  field("flat_share", row->flat);
  field("crease_share", row->crease);
}

// The last columns, which tables of earlier versions lack: none of their rows has such a number.
constexpr std::size_t kLater = 2;

std::vector<std::string> Columns() {
  std::vector<std::string> names;
  const StageStatistics any;
  ForEachColumn(&any, [&](std::string_view name, const auto&) { names.emplace_back(name); });
  return names;
}

std::string Listed(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ",") + name;
  return list;
}

void Take(double number, const CsvReader&, double* field) { *field = number; }

template <class Integer>
void Take(double number, const CsvReader& csv, Integer* field) {
  if (number != std::floor(number) || std::abs(number) > std::numeric_limits<int>::max()) {
    throw InputError("a count that is none", csv.Where(), "a whole number");
  }
  *field = static_cast<Integer>(number);
}

std::vector<StageStatistics> Rows(CsvReader csv, const std::string& origin) {
  const std::vector<std::string> all = Columns(), earlier(all.begin(), all.end() - kLater);
  if (csv.names() != all && csv.names() != earlier) {
    throw InputError("not a statistics table", origin, "the columns " + Listed(all));
  }
  std::vector<StageStatistics> rows;
  while (csv.Next()) {
    StageStatistics row;
    std::size_t column = 0;
    ForEachColumn(&row, [&](std::string_view name, auto& field) {
      if (column == csv.names().size()) return;
      const auto number = csv.Number(column++);
      if (!number) throw InputError("no number in " + std::string(name), csv.Where(), "a number");
      Take(*number, csv, &field);
    });
    rows.push_back(row);
  }
  return rows;
}

}  // namespace

std::string StatisticsToCsv(const std::vector<StageStatistics>& rows) {
  CsvWriter csv(Columns());
  for (const StageStatistics& row : rows) {
    ForEachColumn(&row, [&](std::string_view, const auto& number) {
      csv.Number(static_cast<double>(number));
    });
    csv.EndRow();
  }
  return csv.text();
}

std::vector<StageStatistics> ReadStatistics(const std::filesystem::path& path) {
  return Rows(CsvReader(path), path.string());
}

std::vector<StageStatistics> StatisticsFromCsv(const std::string& csv, const std::string& origin) {
  return Rows(CsvReader::OfText(csv, origin), origin);
}

}  // namespace antigrasp
