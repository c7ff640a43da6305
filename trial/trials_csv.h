#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "antigrasp/core/csv_writer.h"
#include "antigrasp/trial/trial_summary.h"

namespace antigrasp {

// What every row of both tables says of how it was tried.
struct TrialRun {
  std::string protocol;  // its name
  std::string side;      // "after", or "before" of a baseline
  std::string masses;    // "own" or "equal"
  double friction = 0.0;
  bool operator==(const TrialRun&) const = default;
};

// trials.csv (docs/formats.md): a row an object, side and kind of mass.
class TrialsTable {
 public:
  explicit TrialsTable(const Protocol& protocol);
  void Add(const TrialRun& run, const TrialSummary& summary);
  const std::string& text() const { return csv_.text(); }

 private:
  CsvWriter csv_;
};

std::vector<std::string> TrialColumns(const Protocol& protocol);

// A row of it, to the last bit.
struct TrialRow {
  TrialRun run;
  TrialSummary summary;
};
// InputError with file:line for a table that is damaged or of another protocol.
std::vector<TrialRow> ReadTrialRows(const std::filesystem::path& path, const Protocol& protocol);

// executions.csv: a row an execution.
class ExecutionsTable {
 public:
  ExecutionsTable();
  void Add(const TrialRun& run, const std::string& object, const PhysicsTrial& trial);
  std::string TakeText() { return csv_.TakeText(); }  // what was added since, the header first

 private:
  CsvWriter csv_;
};

// means.csv: over the objects that could be tried, beside their originals where there are any; a
// row for every stage of the protocol (all grasps) and group of grasps (its first stage). Percent.
class MeansTable {
 public:
  MeansTable();
  void Add(const TrialRun& run, const Protocol& protocol, const std::vector<TrialSummary>& after,
           const std::vector<TrialSummary>& before);  // `before` may be empty
  const std::string& text() const { return csv_.text(); }

 private:
  CsvWriter csv_;
};

// A row of means.csv. NaN: a gap.
struct TrialMean {
  std::string protocol, masses;
  double friction = 0.0;
  std::string stage, grasps;
  // Percent of the objects; of their originals and the change, in points, of the pairs.
  MeanInterval held = {}, before = {}, difference = {};
};

// InputError with file:line for a table that is damaged, without rows or of another kind.
std::vector<TrialMean> ReadTrialMeans(const std::filesystem::path& path);

// The same for the eye. The last column is what the metric says of the same executions.
std::string TrialLines(const std::vector<TrialSummary>& objects, const Protocol& protocol,
                       const MetricOptions& metric);
// "held: 1 g 71.2 +-3.4 ... (mean over 12 of 14 objects; not in it: 2 no reachable grasp)" and what
// became of the executions.
std::string TrialMeans(const std::vector<TrialSummary>& objects, const Protocol& protocol);
// "1 g -3.1 +-2.0 points of 76.2, ... (48 pairs; not paired: 2 after: no reachable grasp)".
std::string TrialDifference(const std::vector<TrialSummary>& after,
                            const std::vector<TrialSummary>& before, const Protocol& protocol);

}  // namespace antigrasp
