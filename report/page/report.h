#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "antigrasp/mesh/triangle_mesh.h"
#include "antigrasp/quality/graspability.h"
#include "antigrasp/quality/metric_options.h"
#include "antigrasp/quality/score_table.h"

// What the report's page shows (docs/formats.md, "Report"), as plain data. A NaN is a number that
// does not exist: the page shows a gap. Strings are any bytes; what is no UTF-8 is shown as U+FFFD.
namespace antigrasp {

using LabelledText = std::pair<std::string, std::string>;

// One mesh with what the metric says about it.
struct ReportShape {
  std::optional<ScoreSummary> score;
  TriangleMesh mesh;                // any mesh, however broken; none is drawn of an empty one
  double metres_per_unit = 1.0;     // the metric looked at mesh * this
  std::vector<ScoredGrasp> grasps;  // metres, in any order
};

// What became of the object when it was to be printed; lengths in mm, of the object as exported.
struct ReportPrint {
  Eigen::Vector3d size_mm = Eigen::Vector3d::Zero();
  double wall_mm = 0.0;  // thinnest
  bool watertight = false;
  double overhang = 0.0;                     // share of the surface
  std::optional<Eigen::Matrix3d> pose = {};  // table from object
  double pose_probability = 0.0;
  std::vector<std::string> notes = {};
};

// The object before it was changed.
struct ReportOriginal {
  std::string label;
  ReportShape shape;
};

// What a simulation says about the object under one protocol.
struct ReportTrialSeries {
  std::string protocol;
  bool before = false;  // of the original, not of the object
  std::string masses;   // "own", "equal", or not said
  double friction = 0.0;
  double held = 0.0, low = 0.0, high = 0.0;  // share of executions, its 95 % interval
};

struct ReportTrialGrasp {
  std::size_t series = 0;  // index into ReportTrials::series
  int grasp = 0;
  double quality = 0.0;  // robust
  int held = 0, executions = 0;
  std::vector<std::pair<std::string, int>> outcomes;  // words and counts, in order of appearance
};

// An execution to look at, as JSON texts of replays.json: its keys but object and frames; frames.
struct ReportReplay {
  std::string keys, frames;
};

struct ReportTrials {
  std::vector<ReportTrialSeries> series;
  std::vector<ReportTrialGrasp> grasps;
  std::vector<ReportReplay> replays;
};

struct ReportObject {
  std::string name;
  std::size_t group = 0;      // index into Report::groups
  std::optional<bool> elite;  // of a run's samples
  bool random = true;         // not picked by its score
  std::string status;         // "ok", or any words
  ReportShape shape;
  std::optional<ReportOriginal> original;
  std::vector<LabelledText> numbers;
  std::optional<ReportPrint> print;
  std::optional<ReportTrials> trials = {};
};

// A stage of a run in the charts.
struct ReportStage {
  std::string id, label;
  int episode = -1;  // -1: the prior set
  bool control = false;
  int samples = 0;
  std::vector<std::pair<std::string, int>> statuses;
  MeanInterval graspability;
  double elite_threshold = 0.0, coverage = 0.0, nna = 0.0, duplicates = 0.0, diversity = 0.0;
  double flat = 0.0, crease = 0.0;            // shares of edge length
  std::optional<std::vector<double>> scores;  // of the usable objects
};

struct ReportLosses {
  int episode = 0;
  bool control = false;
  std::vector<std::pair<std::string, std::vector<double>>> columns;  // of equal length
};

struct ReportRun {
  std::vector<ReportStage> stages;
  std::vector<ReportLosses> losses;
};

// Objects of the gallery that belong together.
struct ReportGroup {
  std::string id, label;
  std::string note = {};  // how they were chosen; may be empty
};

struct Report {
  std::string title;
  std::string kind;                  // "run", "perturbed", "objects"
  std::vector<std::string> missing;  // sentences
  std::vector<LabelledText> provenance;
  std::optional<std::string> config;  // TOML
  std::optional<MetricOptions> metric;
  std::optional<ReportRun> run;
  std::vector<ReportGroup> groups;
  std::vector<ReportObject> objects;
};

}  // namespace antigrasp
