#include <spdlog/spdlog.h>

#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>

#include "antigrasp/app/commands.h"
#include "antigrasp/app/console.h"
#include "antigrasp/app/flags.h"
#include "antigrasp/app/input_objects.h"
#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/format.h"
#include "antigrasp/quality/graspability.h"

namespace antigrasp {
namespace {

struct EvaluateFlags {
  std::vector<std::string> inputs;
  std::string out;
  std::string grasps;
  std::uint64_t seed = 1;
  int threads = 0;
};

struct ScoredObject {
  InputObject object;
  Graspability score;
  std::string Status() const {
    return object.ok() ? std::string(Name(score.status)) : object.status;
  }
};

// `egad` adds EGAD's own score of the same graspability as the last column.
std::string ScoresCsv(const std::vector<ScoredObject>& scored, bool egad) {
  std::string csv =
      "object,status,num_grasps,graspability,ci_low,ci_high,mean,fraction_nonzero,seconds";
  csv += egad ? ",egad\n" : "\n";
  for (const ScoredObject& item : scored) {
    const Graspability& score = item.score;
    csv += CsvField(item.object.name) + "," + CsvField(item.Status()) + "," +
           std::to_string(score.grasps.size());
    const bool evaluated = score.status != GraspabilityStatus::kNotEvaluable;
    for (const double value :
         {score.value, score.ci_low, score.ci_high, score.mean, score.fraction_nonzero}) {
      csv += "," + (evaluated ? FormatDouble(value) : std::string());
    }
    char seconds[32];
    std::snprintf(seconds, sizeof seconds, ",%.4f", score.seconds);
    csv += seconds;
    if (egad) csv += "," + (evaluated ? FormatDouble(EgadScore(score.value)) : std::string());
    csv += "\n";
  }
  return csv;
}

std::string GraspsCsv(const std::vector<ScoredObject>& scored) {
  std::string csv =
      "object,grasp,p1x,p1y,p1z,n1x,n1y,n1z,p2x,p2y,p2z,n2x,n2y,n2z,axis_x,axis_y,axis_z,width,"
      "robust_quality,approach_x,approach_y,approach_z\n";
  for (const ScoredObject& item : scored) {
    for (std::size_t g = 0; g < item.score.grasps.size(); ++g) {
      const ScoredGrasp& scored_grasp = item.score.grasps[g];
      csv += CsvField(item.object.name) + "," + std::to_string(g);
      const auto add = [&](const Eigen::Vector3d& v) {
        for (int k = 0; k < 3; ++k) csv += "," + FormatDouble(v[k]);
      };
      for (const Contact& contact : scored_grasp.grasp.contacts) {
        add(contact.point);
        add(contact.normal);
      }
      add(scored_grasp.grasp.axis);
      csv +=
          "," + FormatDouble(scored_grasp.grasp.width) + "," + FormatDouble(scored_grasp.quality);
      add(scored_grasp.grasp.approach);
      csv += "\n";
    }
  }
  return csv;
}

std::vector<ScoredObject> ScoreAll(const EvaluateFlags& flags, const MetricOptions& metric) {
  ConsoleObserver console;
  std::vector<InputObject> objects =
      LoadObjects(flags.inputs, flags.threads, console.Phase("reading"));
  std::vector<ScoredObject> scored(objects.size());
  ParallelFor(
      static_cast<std::int64_t>(objects.size()), flags.threads,
      [&](std::int64_t i) {
        const auto slot = static_cast<std::size_t>(i);
        scored[slot].object = std::move(objects[slot]);
        if (!scored[slot].object.ok()) return;
        scored[slot].score = EvaluateGraspability(scored[slot].object.mesh, metric, flags.seed,
                                                  static_cast<std::uint64_t>(i));
      },
      console.Phase("scoring"));
  return scored;
}

void Evaluate(const EvaluateFlags& flags, const MetricFlags& metric_flags) {
  const MetricOptions metric = metric_flags.Resolve();
  const bool egad = metric_flags.preset() == "egad";
  for (const std::string& out : {flags.out, flags.grasps}) {
    if (!out.empty()) const AtomicFile probe(out);  // refuses an unwritable target before the work
  }
  const std::vector<ScoredObject> scored = ScoreAll(flags, metric);
  std::vector<double> values;
  int rejected = 0;
  for (const ScoredObject& item : scored) {
    if (!item.object.note.empty()) spdlog::warn("{}: {}", item.object.name, item.object.note);
    const bool evaluated = item.score.status != GraspabilityStatus::kNotEvaluable;
    rejected += evaluated ? 0 : 1;
    values.push_back(evaluated ? item.score.value : std::numeric_limits<double>::quiet_NaN());
  }
  if (!flags.grasps.empty()) WriteFileAtomic(flags.grasps, GraspsCsv(scored));
  if (flags.out.empty()) {
    std::printf("%s", ScoresCsv(scored, egad).c_str());
  } else {
    WriteFileAtomic(flags.out, ScoresCsv(scored, egad));
    MetricOptions copy = metric;
    OptionTable table;
    Bind(&table, &copy);
    WriteFileAtomic(flags.out + ".metric.toml",
                    "seed = " + std::to_string(flags.seed) + "\n\n" + table.Dump());
  }
  const MeanInterval mean = MeanWithInterval(values);
  std::fprintf(stderr, "%d objects scored, %d not: mean graspability %.5f +-%.5f (95 %%)\n",
               mean.count, rejected, mean.mean, mean.half_width);
}

}  // namespace

void AddEvaluateCommand(CLI::App* app) {
  const auto flags = std::make_shared<EvaluateFlags>();
  CLI::App* command = app->add_subcommand("evaluate", "Score the graspability of objects");
  command->add_option("OBJECT", flags->inputs, "meshes, folders of meshes, SDF files")->required();
  command->add_option("--out", flags->out,
                      "scores (CSV); the constants go to the same name plus .metric.toml. "
                      "Without it the scores go to standard output");
  command->add_option("--grasps", flags->grasps, "every sampled grasp (CSV)");
  command->add_option("--seed", flags->seed, "random seed")->capture_default_str();
  command->add_option("--threads", flags->threads, "threads; 0 = all; scores do not depend on it")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  const auto metric = std::make_shared<MetricFlags>(command);
  command->callback([flags, metric] { Evaluate(*flags, *metric); });
}

}  // namespace antigrasp
