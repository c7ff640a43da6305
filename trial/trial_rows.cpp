#include <cmath>

#include "antigrasp/core/csv_reader.h"
#include "antigrasp/core/error.h"
#include "antigrasp/trial/trials_csv.h"

namespace antigrasp {
namespace {

// The numbers of a row one after another, as TrialsTable has them.
class Fields {
 public:
  explicit Fields(const CsvReader& csv) : csv_(csv) {}
  std::string Text() { return csv_.Field(at_++); }
  double Number() { return csv_.NumberOrGap(at_++); }
  int Count() {
    const double value = Number();
    if (value >= 0.0 && value <= 1e9 && value == std::floor(value)) return static_cast<int>(value);
    throw InputError(csv_.names()[at_ - 1] + " = " + csv_.Field(at_ - 1), csv_.Where(),
                     "a whole number");
  }

 private:
  const CsvReader& csv_;
  std::size_t at_ = 0;
};

TrialRow ReadRow(const CsvReader& csv, const Protocol& protocol) {
  Fields fields(csv);
  TrialRow row;
  TrialSummary& one = row.summary;
  one.object = fields.Text();
  row.run.protocol = fields.Text();
  row.run.side = fields.Text();
  row.run.masses = fields.Text();
  row.run.friction = fields.Number();
  one.status = fields.Text();
  one.mass = fields.Number();
  for (int* count : {&one.poses, &one.wanted, &one.candidates, &one.grasps, &one.executions}) {
    *count = fields.Count();
  }
  for (std::size_t stage = 0; stage < protocol.stages.size(); ++stage) {
    Share share;
    for (double* number : {&share.value, &share.interval.low, &share.interval.high}) {
      *number = fields.Number();
    }
    one.held.push_back(share);
  }
  one.group[0] = one.held.front().value;
  for (std::size_t group = 1; group < kGraspGroups; ++group) one.group[group] = fields.Number();
  one.outcomes[0] = one.executions;  // held, what no other outcome is
  for (std::size_t i = 1; i < one.outcomes.size(); ++i) {
    one.outcomes[i] = fields.Count();
    one.outcomes[0] -= one.outcomes[i];
  }
  one.untrusted = fields.Count();
  one.predicted = fields.Number();
  one.quality = fields.Number();
  return row;
}

}  // namespace

std::vector<TrialRow> ReadTrialRows(const std::filesystem::path& path, const Protocol& protocol) {
  CsvReader csv(path);
  if (csv.names() != TrialColumns(protocol)) {
    throw InputError("other columns", path.string(),
                     "trials.csv of protocol " + ChoiceName(protocol.name));
  }
  std::vector<TrialRow> rows;
  while (csv.Next()) rows.push_back(ReadRow(csv, protocol));
  return rows;
}

}  // namespace antigrasp
