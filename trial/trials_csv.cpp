#include "antigrasp/trial/trials_csv.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "antigrasp/core/angles.h"
#include "antigrasp/core/csv_reader.h"
#include "antigrasp/core/error.h"
#include "antigrasp/core/format.h"
#include "antigrasp/core/word_count.h"

namespace antigrasp {
namespace {

constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();
constexpr const char* kHalfWidthBefore = "held_before_half_width";  // earlier tables lack it

std::string Underscored(std::string name) {
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
}

// "open" of "open: 3 boundary edges".
std::string Reason(const std::string& status) { return status.substr(0, status.find(':')); }

std::string Percent(double share) {
  char text[32];
  std::snprintf(text, sizeof text, "%5.1f", 100.0 * share);
  return std::isfinite(share) ? text : "    -";
}

// "; not in it: 2 no reachable grasp, 1 open", or nothing.
std::string WithoutShare(const std::vector<TrialSummary>& objects) {
  WordCount reasons;
  for (const TrialSummary& one : objects) {
    if (!one.HasShare()) reasons.Add(Reason(one.status));
  }
  return (reasons.total() > 0 ? "; not in it: " : "") + reasons.Text();
}

std::string Row(const TrialSummary& one, std::size_t width) {
  char text[200];
  std::string line = one.object + std::string(width - one.object.size(), ' ');
  if (one.status != "ok") return line + "  " + one.status + "\n";
  std::snprintf(text, sizeof text, "  %7.1f  %5.1f  %6d ", 1000.0 * one.mass, 100.0 * one.Kept(),
                one.grasps);
  line += text;
  std::snprintf(text, sizeof text, " %s [%s,%s]", Percent(one.held.front().value).c_str(),
                Percent(one.held.front().interval.low).c_str(),
                Percent(one.held.front().interval.high).c_str());
  line += text;
  for (std::size_t i = 1; i < one.held.size(); ++i) line += "  " + Percent(one.held[i].value);
  for (std::size_t group = 1; group < 3; ++group) line += "  " + Percent(one.group[group]);
  return line + "  " + Percent(one.predicted) + "\n";
}

}  // namespace

std::vector<std::string> TrialColumns(const Protocol& protocol) {
  std::vector<std::string> columns = {"object",   "protocol",   "side",   "masses",
                                      "friction", "status",     "mass",   "poses",
                                      "wanted",   "candidates", "grasps", "executions"};
  for (std::size_t i = 0; i < protocol.stages.size(); ++i) {
    const std::string name = i == 0 ? "held" : "held_" + Underscored(protocol.stages[i].name);
    for (const char* end : {"", "_low", "_high"}) columns.push_back(name + end);
  }
  for (const char* group : {"best", "top_quarter", "percentile_75"}) {
    columns.push_back(std::string("held_") + group);
  }
  for (const auto& [outcome, name] : ChoicesOf(Outcome{})) {
    if (outcome != Outcome::kHeld) columns.push_back(Underscored(std::string(name)));
  }
  columns.insert(columns.end(), {"untrusted", "force_closure", "mean_robust_quality"});
  return columns;
}

TrialsTable::TrialsTable(const Protocol& protocol) : csv_(TrialColumns(protocol)) {}

void TrialsTable::Add(const TrialRun& run, const TrialSummary& one) {
  csv_.Text(one.object).Text(run.protocol).Text(run.side).Text(run.masses).Number(run.friction);
  csv_.Text(one.status).NumberOrGap(one.mass).Count(one.poses).Count(one.wanted);
  csv_.Count(one.candidates).Count(one.grasps).Count(one.executions);
  for (const Share& share : one.held) {
    csv_.NumbersOrGaps({share.value, share.interval.low, share.interval.high});
  }
  for (std::size_t group = 1; group < kGraspGroups; ++group) csv_.NumberOrGap(one.group[group]);
  for (std::size_t i = 1; i < one.outcomes.size(); ++i) csv_.Count(one.outcomes[i]);
  csv_.Count(one.untrusted).NumberOrGap(one.predicted).NumberOrGap(one.quality);
  csv_.EndRow();
}

ExecutionsTable::ExecutionsTable()
    : csv_({"object",           "protocol", "side",     "masses",         "grasp",
            "execution",        "series",   "pose",     "robust_quality", "width",
            "friction",         "epsilon",  "outcome",  "stages",         "closing_move_mm",
            "closing_turn_deg", "move_mm",  "turn_deg", "seconds",        "contacts",
            "penetration_mm"}) {}

void ExecutionsTable::Add(const TrialRun& run, const std::string& object,
                          const PhysicsTrial& trial) {
  for (std::size_t i = 0; i < trial.grasps.size(); ++i) {
    const ExecutedGrasp& grasp = trial.grasps[i];
    for (std::size_t k = 0; k < grasp.draws.size(); ++k) {
      const ExecutedDraw& draw = grasp.draws[k];
      const Execution& e = draw.execution;
      csv_.Text(object).Text(run.protocol).Text(run.side).Text(run.masses);
      csv_.Count(static_cast<std::int64_t>(i)).Count(static_cast<std::int64_t>(k));
      csv_.Count(static_cast<std::int64_t>(grasp.series));
      csv_.Count(static_cast<std::int64_t>(grasp.planned.pose));
      csv_.Numbers(
          {grasp.planned.quality, grasp.planned.grasp.width, draw.friction, draw.predicted});
      csv_.Text(ChoiceName(e.outcome)).Count(e.stages);
      csv_.Numbers({1e3 * e.closing_move, e.closing_turn / kDegree, 1e3 * e.move, e.turn / kDegree,
                    e.seconds});
      csv_.Count(e.contacts).Number(1e3 * e.penetration).EndRow();
    }
  }
}

MeansTable::MeansTable()
    : csv_({"protocol", "masses", "friction", "stage", "grasps", "objects", "held",
            "held_half_width", "held_before", "pairs", "difference", "difference_half_width",
            kHalfWidthBefore}) {}

void MeansTable::Add(const TrialRun& run, const Protocol& protocol,
                     const std::vector<TrialSummary>& after,
                     const std::vector<TrialSummary>& before) {
  const auto row = [&](const std::string& stage, const std::string& grasps, const auto& share_of) {
    std::vector<double> held, of_pairs, difference;
    for (std::size_t i = 0; i < after.size(); ++i) {
      held.push_back(100.0 * share_of(after[i]));
      if (before.empty()) continue;
      const double original = 100.0 * share_of(before[i]);
      difference.push_back(held.back() - original);
      of_pairs.push_back(original + 0.0 * difference.back());
    }
    const MeanInterval mean = MeanWithInterval(held), change = MeanWithInterval(difference);
    const MeanInterval original = MeanWithInterval(of_pairs);
    csv_.Text(run.protocol).Text(run.masses).Number(run.friction).Text(stage).Text(grasps);
    csv_.Count(mean.count).NumbersOrGaps({mean.mean, mean.half_width});
    csv_.NumberOrGap(original.mean).Count(change.count);
    csv_.NumbersOrGaps({change.mean, change.half_width, original.half_width}).EndRow();
  };
  for (std::size_t stage = 0; stage < protocol.stages.size(); ++stage) {
    row(protocol.stages[stage].name, "all",
        [&](const TrialSummary& one) { return one.held[stage].value; });
  }
  for (std::size_t group = 1; group < kGraspGroups; ++group) {
    row(protocol.stages.front().name, ChoiceName(static_cast<GraspGroup>(group)),
        [&](const TrialSummary& one) { return one.group[group]; });
  }
  row(protocol.stages.front().name, "force closure",
      [](const TrialSummary& one) { return one.predicted; });
  row("", "candidates kept", [](const TrialSummary& one) { return one.Kept(); });
}

std::vector<TrialMean> ReadTrialMeans(const std::filesystem::path& path) {
  CsvReader csv(path);
  const auto text = [&](const char* name) { return csv.Field(csv.RequiredColumn(name)); };
  const auto number = [&](const char* name, double low, double high) {
    const double value = csv.NumberOrGap(csv.RequiredColumn(name));
    if (std::isnan(value) || (low <= value && value <= high)) return value;
    throw InputError(std::string(name) + " = " + FormatDouble(value), csv.Where(),
                     "a number in [" + FormatDouble(low) + ", " + FormatDouble(high) + "]");
  };
  const auto count = [&](const char* name) {
    const double value = number(name, 0.0, 1e9);
    return std::isnan(value) ? 0 : static_cast<int>(value);
  };
  std::vector<TrialMean> rows;
  while (csv.Next()) {
    TrialMean row{text("protocol"), text("masses"), number("friction", 0.0, 1e6), text("stage"),
                  text("grasps")};
    if (std::isnan(row.friction)) throw InputError("no friction", csv.Where(), "a number");
    row.held = {number("held", 0.0, 100.0), number("held_half_width", 0.0, 1e6), count("objects")};
    row.before = {number("held_before", 0.0, 100.0), kNoNumber, count("pairs")};
    if (csv.Column(kHalfWidthBefore)) row.before.half_width = number(kHalfWidthBefore, 0.0, 1e6);
    row.difference = {number("difference", -100.0, 100.0),
                      number("difference_half_width", 0.0, 1e6), row.before.count};
    rows.push_back(std::move(row));
  }
  if (rows.empty()) throw InputError("no rows", path.string(), "means.csv of antigrasp trial");
  return rows;
}

std::string TrialLines(const std::vector<TrialSummary>& objects, const Protocol& protocol,
                       const MetricOptions& metric) {
  std::size_t width = 6;
  for (const TrialSummary& one : objects) width = std::max(width, one.object.size());
  std::string text = "object" + std::string(width - 6, ' ') + "   mass g   kept  grasps  " +
                     protocol.stages.front().name;
  text += std::string(20 - std::min<std::size_t>(20, protocol.stages.front().name.size()), ' ');
  for (std::size_t i = 1; i < protocol.stages.size(); ++i) {
    const std::string& name = protocol.stages[i].name;
    text += std::string(7 - std::min<std::size_t>(7, name.size()), ' ') + name;
  }
  text += "   best    top  ";
  text += metric.closing == ClosingEnd::kSettled ? "settled holds\n" : "force closure\n";
  for (const TrialSummary& one : objects) text += Row(one, width);
  return text;
}

std::string TrialMeans(const std::vector<TrialSummary>& objects, const Protocol& protocol) {
  std::string text;
  for (std::size_t i = 0; i < protocol.stages.size(); ++i) {
    text += (i == 0 ? "held: " : ", ") + protocol.stages[i].name + " " +
            MeanText(HeldOver(objects, i), 1);
  }
  std::array<std::int64_t, ChoicesOf(Outcome{}).size()> outcomes{};
  std::int64_t executions = 0, untrusted = 0;
  for (const TrialSummary& one : objects) {
    executions += one.executions;
    untrusted += one.untrusted;
    for (std::size_t k = 0; k < outcomes.size(); ++k) outcomes[k] += one.outcomes[k];
  }
  text += " % of the executions (mean over " + std::to_string(HeldOver(objects, 0).count) + " of " +
          std::to_string(objects.size()) + " objects" + WithoutShare(objects) + ")\n" +
          std::to_string(executions) + " executions:";
  for (const auto& [outcome, name] : ChoicesOf(Outcome{})) {
    char part[80];
    const auto count = outcomes[static_cast<std::size_t>(outcome)];
    if (count == 0) continue;
    std::snprintf(part, sizeof part, " %.1f %% %s,",
                  100.0 * static_cast<double>(count) / static_cast<double>(executions),
                  std::string(name).c_str());
    text += part;
  }
  return text + " " + std::to_string(untrusted) + " with a penetration above 0.1 mm\n";
}

std::string TrialDifference(const std::vector<TrialSummary>& after,
                            const std::vector<TrialSummary>& before, const Protocol& protocol) {
  std::vector<TrialSummary> paired;  // originals
  WordCount without;
  for (std::size_t i = 0; i < after.size(); ++i) {
    if (!before[i].HasShare()) {
      without.Add("before: " + Reason(before[i].status));
    } else if (!after[i].HasShare()) {
      without.Add("after: " + Reason(after[i].status));
    } else {
      paired.push_back(before[i]);
    }
  }
  std::string text;
  for (std::size_t i = 0; i < protocol.stages.size(); ++i) {
    text += (i == 0 ? "" : ", ") + protocol.stages[i].name + " " +
            MeanText(DifferenceOver(after, before, i), 1) + " points of " +
            MeanText({HeldOver(paired, i).mean, std::nan(""), 0}, 1);
  }
  return text + " (" + std::to_string(paired.size()) + " pairs" +
         (without.total() > 0 ? "; not paired: " : "") + without.Text() + ")";
}

}  // namespace antigrasp
