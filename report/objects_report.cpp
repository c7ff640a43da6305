#include "antigrasp/report/objects_report.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include "antigrasp/core/csv_reader.h"
#include "antigrasp/core/error.h"
#include "antigrasp/core/format.h"
#include "antigrasp/datasets/objects.h"
#include "antigrasp/quality/object_size.h"
#include "antigrasp/quality/sampling_effort.h"
#include "antigrasp/quality/score_table.h"

namespace antigrasp {
namespace {

namespace fs = std::filesystem;

struct Table {
  std::string path;
  std::vector<ScoreRow> rows;
  std::optional<SavedMetric> metric;
};

Table ReadTable(const std::string& path, std::vector<std::string>* missing) {
  Table table{path, ReadScores(path), {}};
  const std::string metric = path + ".metric.toml";
  if (fs::exists(metric)) {
    table.metric = ReadSavedMetric(metric);
  } else {
    missing->push_back(metric + " is not there: the constants of the metric are not known.");
  }
  return table;
}

// The row of the object: the one at its own place, else the one of its name.
const ScoreRow* RowOf(const std::string& name, std::size_t place, const Table& table) {
  if (place < table.rows.size() && table.rows[place].object == name) return &table.rows[place];
  const auto is_it = [&](const ScoreRow& row) { return row.object == name; };
  const auto found = std::find_if(table.rows.begin(), table.rows.end(), is_it);
  return found == table.rows.end() ? nullptr : &*found;
}

// What `evaluate` writes beside the score, in the page's words.
std::vector<LabelledText> ExtrasOf(const ScoreRow& row) {
  static const std::map<std::string, std::string> kLabels = {
      {"egad", "EGAD's score"},
      {"baseline", "baseline"},
      {"difference", "difference to the baseline"},
      {"graspability_fresh_draws", "graspability under fresh draws"},
      {"judge", "score by the judge"}};
  std::vector<LabelledText> numbers;
  for (const auto& [name, value] : row.extras) {
    const auto label = kLabels.find(name);
    if (label == kLabels.end() || std::isnan(value)) continue;
    numbers.emplace_back(label->second, FormatDouble(value));
  }
  return numbers;
}

ReportObject FromRow(const ScoreRow& row, std::size_t group) {
  ReportObject object;
  object.name = row.object;
  object.group = group;
  object.status = row.status;
  object.shape.score = row.score;
  object.numbers = ExtrasOf(row);
  return object;
}

Report TablesReport(const ReportSettings& settings, std::vector<Table> tables, Report report) {
  const SavedMetric* first = nullptr;
  for (std::size_t t = 0; t < tables.size(); ++t) {
    report.groups.push_back({"input-" + std::to_string(t), tables[t].path});
    for (const ScoreRow& row : tables[t].rows) {
      if (settings.limit > 0 && report.objects.size() == settings.limit) break;
      report.objects.push_back(FromRow(row, t));
    }
    if (!tables[t].metric) continue;
    if (first == nullptr) {
      first = &*tables[t].metric;
      report.metric = first->metric;
      report.config = first->toml;
      continue;
    }
    const SavedMetric &one = *tables[t].metric, &of_first = *first;
    if (one.Constants() != of_first.Constants()) {
      report.missing.push_back(tables[t].path + " was scored with other constants than " +
                               tables[0].path + ": the numbers do not compare.");
    } else if (!one.judge.empty() && !of_first.judge.empty() && one.toml != of_first.toml) {
      report.missing.push_back(tables[t].path + " was judged by " + one.judge + ", " +
                               tables[0].path + " by " + of_first.judge +
                               (one.judge == of_first.judge ? ", set otherwise" : "") +
                               ": what the judges say does not compare.");
    }
  }
  return report;
}

std::vector<ReportObject> LoadAll(const ObjectSource& source, const ReportSettings& settings,
                                  RunObserver* observer) {
  std::vector<ReportObject> objects;
  for (InputObject& input :
       LoadObjects(source, settings.threads, observer->Phase("reading"), settings.limit)) {
    ReportObject object;
    object.name = std::move(input.name);
    object.group = source.input(std::ssize(objects));
    object.status = std::move(input.status);
    object.shape.mesh = std::move(input.mesh);
    if (!input.note.empty()) object.numbers.emplace_back("note", input.note);
    objects.push_back(std::move(object));
  }
  return objects;
}

}  // namespace

bool IsScoreTable(const std::string& path) {
  if (fs::path(path).extension() != ".csv" || !fs::is_regular_file(path)) return false;
  const CsvReader csv(path);
  return csv.Column("object") && csv.Column("graspability");
}

Report ObjectsReport(const ReportSettings& settings, RunObserver* observer) {
  Report report;
  report.kind = "objects";
  std::vector<Table> tables;
  std::vector<std::string> inputs;
  for (const std::string& input : settings.inputs) {
    if (IsScoreTable(input)) {
      tables.push_back(ReadTable(input, &report.missing));
    } else {
      inputs.push_back(input);
    }
  }
  if (inputs.empty()) return TablesReport(settings, std::move(tables), std::move(report));
  if (tables.size() > 1) {
    throw InputError("objects with " + std::to_string(tables.size()) + " tables of scores",
                     tables[1].path, "one table, that of these objects");
  }
  const bool saved = !tables.empty() && tables[0].metric;
  const ObjectSource source(inputs, GridUnit::kOfFiles,
                            UnitToReadIn(saved ? tables[0].metric->metric : settings.metric));
  SavedMetric metric{settings.seed, settings.metric, ""};
  if (settings.raise_effort) RaiseEffortForFew(source.size(), &metric.metric);
  metric.toml = MetricToml(metric.metric, metric.seed);
  if (saved) metric = *tables[0].metric;
  report.metric = metric.metric;
  report.config = metric.toml;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    report.groups.push_back({"input-" + std::to_string(i), inputs[i]});
  }
  report.objects = LoadAll(source, settings, observer);
  for (std::size_t i = 0; i < report.objects.size() && !tables.empty(); ++i) {
    const ScoreRow* row = RowOf(report.objects[i].name, i, tables[0]);
    if (row == nullptr) {
      report.missing.push_back(report.objects[i].name + " has no row in " + tables[0].path + ".");
    } else {
      for (LabelledText& extra : ExtrasOf(*row)) {
        report.objects[i].numbers.push_back(std::move(extra));
      }
    }
  }
  const std::vector<Graspability> scores = ScoreAll(
      std::ssize(report.objects),
      [&](std::int64_t i) {
        const ReportObject& object = report.objects[static_cast<std::size_t>(i)];
        return object.status == "ok" ? &object.shape.mesh : nullptr;
      },
      [&](std::int64_t i) { return source.stream(i); }, metric.metric, metric.seed,
      settings.threads, observer->Phase("scoring"));
  UnlikelySizes sizes(metric.metric);
  for (std::size_t i = 0; i < scores.size(); ++i) {
    ReportObject& object = report.objects[i];
    if (object.status != "ok") continue;
    sizes.Add(object.name, Bounds(object.shape.mesh).Extent(), &scores[i]);
    object.status = std::string(Name(scores[i].status));
    object.shape = ShapeOf(std::move(object.shape.mesh), scores[i]);
  }
  for (std::string& text : sizes.Texts()) report.missing.push_back(std::move(text));
  return report;
}

}  // namespace antigrasp
