#include "antigrasp/report/page/trial_folder.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <vector>

#include "antigrasp/core/csv_reader.h"
#include "antigrasp/core/error.h"
#include "antigrasp/datasets/object_names.h"
#include "antigrasp/report/page/replay_file.h"

namespace antigrasp {
namespace {

namespace fs = std::filesystem;

constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

// The columns that both tables have.
class TrialRows {
 public:
  explicit TrialRows(const fs::path& path)
      : csv(path),
        object_(csv.RequiredColumn("object")),
        protocol_(csv.RequiredColumn("protocol")),
        side_(csv.Column("side")),
        masses_(csv.Column("masses")) {}

  CsvReader csv;
  const std::string& object() const { return csv.Field(object_); }
  const std::string& protocol() const { return csv.Field(protocol_); }
  std::string masses() const { return masses_ ? csv.Field(*masses_) : ""; }
  bool before() const {
    const std::string side = side_ ? csv.Field(*side_) : "";
    if (side.empty() || side == "after") return false;
    if (side != "before") throw InputError("side = " + side, csv.Where(), "before or after");
    return true;
  }

 private:
  std::size_t object_, protocol_;
  std::optional<std::size_t> side_, masses_;
};

// Of this protocol, side and kind of mass; a new one, without numbers, where there is none.
std::size_t SeriesOf(const TrialRows& rows, ReportTrials* trials) {
  const auto found = std::find_if(
      trials->series.begin(), trials->series.end(), [&](const ReportTrialSeries& series) {
        return series.protocol == rows.protocol() && series.before == rows.before() &&
               series.masses == rows.masses();
      });
  const auto index = static_cast<std::size_t>(found - trials->series.begin());
  if (found == trials->series.end()) {
    trials->series.push_back({rows.protocol(), rows.before(), rows.masses(), kNoNumber, kNoNumber,
                              kNoNumber, kNoNumber});
  }
  return index;
}

void ReadShares(const fs::path& path, TrialsByObject* trials) {
  TrialRows rows(path);
  const std::size_t held = rows.csv.RequiredColumn("held");
  const std::size_t low = rows.csv.RequiredColumn("held_low");
  const std::size_t high = rows.csv.RequiredColumn("held_high");
  const auto friction = rows.csv.Column("friction");
  while (rows.csv.Next()) {
    ReportTrials& of_object = (*trials)[rows.object()];
    const std::size_t before = of_object.series.size();
    const std::size_t index = SeriesOf(rows, &of_object);
    if (index < before) {
      throw InputError(rows.object() + " under " + rows.protocol() + " once more", rows.csv.Where(),
                       "one row for an object, protocol, side and kind of mass");
    }
    ReportTrialSeries& series = of_object.series[index];
    series.held = rows.csv.NumberOrGap(held);
    series.low = rows.csv.NumberOrGap(low);
    series.high = rows.csv.NumberOrGap(high);
    if (friction) series.friction = rows.csv.NumberOrGap(*friction);
  }
}

void CountOutcome(const std::string& outcome, ReportTrialGrasp* grasp) {
  ++grasp->executions;
  if (outcome.starts_with("held")) ++grasp->held;
  const auto counted = std::find_if(grasp->outcomes.begin(), grasp->outcomes.end(),
                                    [&](const auto& word) { return word.first == outcome; });
  if (counted == grasp->outcomes.end()) {
    grasp->outcomes.emplace_back(outcome, 1);
  } else {
    ++counted->second;
  }
}

void ReadExecutions(const fs::path& path, TrialsByObject* trials) {
  TrialRows rows(path);
  const std::size_t number = rows.csv.RequiredColumn("grasp");
  const std::size_t quality = rows.csv.RequiredColumn("robust_quality");
  const std::size_t outcome = rows.csv.RequiredColumn("outcome");
  std::map<std::tuple<std::string, std::size_t, int>, std::size_t> places;
  while (rows.csv.Next()) {
    const auto value = rows.csv.Number(number);
    if (!value || std::trunc(*value) != *value || std::abs(*value) > 1e9) {
      throw InputError("grasp = " + rows.csv.Field(number), rows.csv.Where(), "a whole number");
    }
    ReportTrials& of_object = (*trials)[rows.object()];
    const std::size_t series = SeriesOf(rows, &of_object);
    const int grasp = static_cast<int>(*value);
    const auto [place, is_new] =
        places.try_emplace({rows.object(), series, grasp}, of_object.grasps.size());
    if (is_new) {
      of_object.grasps.push_back({series, grasp, rows.csv.NumberOrGap(quality), 0, 0, {}});
    }
    CountOutcome(rows.csv.Field(outcome), &of_object.grasps[place->second]);
  }
}

// By its name; a perturbed object is named after its original ("jug.obj"), and its trials after the
// file that it was written to ("jug.stl").
TrialsByObject::const_iterator TrialsOf(const std::string& name, const TrialsByObject& trials) {
  auto found = trials.find(name);
  for (const std::string& written : {name, FileNameOf(name)}) {
    for (const char* extension : {".stl", ".ply"}) {
      if (found == trials.end()) found = trials.find(written + extension);
    }
  }
  return found;
}

}  // namespace

TrialsByObject ReadTrials(const std::vector<std::string>& folders) {
  TrialsByObject trials;
  for (const std::string& name : folders) {
    const fs::path folder = name;
    for (const char* table : {"trials.csv", "executions.csv"}) {
      if (fs::is_regular_file(folder / table)) continue;
      throw InputError(std::string("no ") + table, name,
                       "a folder that antigrasp trial wrote, with trials.csv and executions.csv");
    }
    ReadShares(folder / "trials.csv", &trials);
    ReadExecutions(folder / "executions.csv", &trials);
    const fs::path replays = folder / "replays.json";
    if (!fs::exists(replays)) continue;
    for (auto& [object, replay] : ReadReplays(replays.string())) {
      trials[object].replays.push_back(std::move(replay));
    }
  }
  return trials;
}

void AddTrials(const TrialsByObject& trials, Report* report) {
  std::size_t without = 0;
  std::set<std::string> shown;
  for (ReportObject& object : report->objects) {
    const auto found = TrialsOf(object.name, trials);
    if (found == trials.end()) {
      ++without;
    } else {
      object.trials = found->second;
      shown.insert(found->first);
    }
  }
  std::vector<std::string> not_shown;
  for (const auto& [name, unused] : trials) {
    if (!shown.contains(name)) not_shown.push_back(name);
  }
  if (!not_shown.empty()) {
    report->missing.push_back(std::to_string(not_shown.size()) + " of " +
                              std::to_string(trials.size()) +
                              " objects with trials are not shown here: " + not_shown[0] +
                              (not_shown.size() > 1 ? ", ..." : "") + ".");
  }
  if (without > 0) {
    report->missing.push_back(std::to_string(without) + " of " +
                              std::to_string(report->objects.size()) + " objects have no trials.");
  }
}

}  // namespace antigrasp
