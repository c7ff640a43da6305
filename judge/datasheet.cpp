#include "antigrasp/judge/datasheet.h"

#include <cmath>
#include <cstdio>
#include <map>

#include "antigrasp/core/format.h"
#include "antigrasp/core/statistics.h"
#include "antigrasp/core/version.h"
#include "antigrasp/judge/pair_split.h"
#include "antigrasp/quality/object_size.h"

namespace antigrasp {
namespace {

// "0.00194 +-0.00012 | 0.00150 +-0.00010 | -0.00044 +-0.00005".
std::string BeforeAfter(const std::array<std::vector<double>, 2>& values, double factor,
                        int decimals) {
  std::array<std::vector<double>, 3> scaled;
  for (std::size_t i = 0; i < values[0].size(); ++i) {
    const double difference = factor * (values[1][i] - values[0][i]);
    if (std::isnan(difference)) continue;  // of pairs
    scaled[0].push_back(factor * values[0][i]);
    scaled[1].push_back(factor * values[1][i]);
    scaled[2].push_back(scaled[1].back() - scaled[0].back());
  }
  std::string text;
  for (const auto& column : scaled) {
    text += (text.empty() ? "" : " | ") + MeanText(MeanWithInterval(column), decimals);
  }
  return text;
}

}  // namespace

Datasheet::Datasheet(const PairRequest& request, const MetricOptions& metric,
                     const MetricOptions& trial_metric, const PhysicsTrialOptions& trial)
    : request_(request), metric_(metric), trial_metric_(trial_metric), trial_(trial) {}

void Datasheet::Add(const LabelledObject& before, const LabelledObject& after) {
  if (!before.ok() || !after.ok()) {
    left_out_.Add(before.ok() || before.status.starts_with("no after") ? after.status
                                                                       : before.status);
    return;
  }
  splits_.Add(before.split);
  const std::array<const LabelledObject*, 2> sides = {&before, &after};
  for (std::size_t k = 0; k < 2; ++k) {
    graspability_[k].push_back(sides[k]->score.value);
    held_[k].push_back(sides[k]->summary.held.front().value);
    if (!sides[k]->summary.HasShare()) without_share_[k].Add(sides[k]->summary.status);
    grasps_[k] += sides[k]->summary.grasps;
    executions_[k] += sides[k]->summary.executions;
  }
}

std::string Datasheet::Means() const {
  return "| judge | before | after | change |\n| --- | --- | --- | --- |\n| graspability | " +
         BeforeAfter(graspability_, 1.0, 5) + " |\n| held, % of executions | " +
         BeforeAfter(held_, 100.0, 1) + " |\n" + Missing();
}

// "No share held, left out of its means: 1 no reachable grasp before, 2 after."; or nothing.
std::string Datasheet::Missing() const {
  std::string text;
  for (std::size_t k = 0; k < 2; ++k) {
    if (without_share_[k].total() == 0) continue;
    text += (text.empty() ? "" : ", ") + without_share_[k].Text() + (k == 0 ? " before" : " after");
  }
  return text.empty() ? "" : "\nWithout a share held, and in no mean of it: " + text + ".\n";
}

std::vector<std::string> Datasheet::EmptySplits() const {
  static const std::map<std::string, std::string> kFor = {
      {"train", "to train on"}, {"test", "to test on"}, {"val", "to validate on"}};
  std::vector<std::string> sentences;
  for (const std::string& split : SplitsWithShare(request_.train, request_.val)) {
    if (splits_.Of(split) > 0) continue;
    sentences.push_back("no pair " + kFor.at(split) + " (split " + split + ") among " +
                        std::to_string(pairs()));
  }
  return sentences;
}

std::string Datasheet::Summary() const {
  std::string text = std::to_string(pairs()) + " pairs (" + splits_.Text() + "), " +
                     std::to_string(grasps_[0]) + " and " + std::to_string(grasps_[1]) +
                     " grasps, " + std::to_string(executions_[0] + executions_[1]) +
                     " executions\n";
  if (left_out_.total() > 0) text += "left out: " + left_out_.Text() + "\n";
  return text + Means();
}

std::string Datasheet::Text() const {
  const std::string protocol = ChoiceName(trial_.protocol);
  const std::string mass = trial_.mass > 0.0
                               ? FormatDouble(1000.0 * trial_.mass) + " g each"
                               : FormatDouble(trial_.density) + " kg/m3 times the volume";
  std::string text = "# Objects before and after a change, with grasps and labels\n\n";
  text += "Written by antigrasp " + ProgramVersion() + " (" + ProgramCommit() +
          "), `antigrasp dataset pair`, seed " + std::to_string(request_.seed) + ".\n\n";
  text +=
      "## Motivation\n\nObjects that look alike and differ in how well a parallel jaw holds them: "
      "to "
      "test a grasping policy on the\nobjects that were changed against it, and to train it on "
      "them.\n\n";
  text += "## Composition\n\n" + std::to_string(pairs()) + " pairs (" + splits_.Text() +
          "), a mesh before and one after the change each; " + std::to_string(grasps_[0]) +
          " and " + std::to_string(grasps_[1]) +
          " grasps.\nMeshes are closed and outward, in metres, " + SizeText(metric_) +
          ". No people, no private data.\n";
  if (left_out_.total() > 0) {
    text += "Left out, with a row in objects.csv that says so: " + left_out_.Text() + ".\n";
  }
  text +=
      "\n| file | content |\n| --- | --- |\n"
      "| `before/`, `after/` | meshes (OBJ), equal names are a pair |\n"
      "| `objects.csv` | a row an object and side: split, mesh, size, labels of both judges |\n"
      "| `grasps_before.csv`, `grasps_after.csv` | a row a grasp: pose, robust quality, share held "
      "|\n"
      "| `metric.toml`, `trial.toml` | every constant of the two judges |\n\n"
      "Columns: docs/formats.md of antigrasp, \"Pairs of objects\".\n\n";
  text += "## How it was made\n\nThe objects come from `" + request_.before + "` (before) and `" +
          request_.after +
          "` (after), repaired where they were no solids.\nNo robot ran, nothing was measured on "
          "real objects.\n\n";
  text +=
      "## Judges\n\n- **Graspability** (Wang et al. 2019): the " +
      FormatDouble(metric_.percentile) + "th percentile of the robust quality of " +
      std::to_string(metric_.num_grasps) + " antipodal grasps, friction " +
      FormatDouble(metric_.friction) +
      ". It says nothing of what happens after the first touch.\n- **Trial**: share of "
      "simulated executions held, protocol `" +
      protocol + "`, friction " + FormatDouble(trial_metric_.friction) + ", " + mass + ", MuJoCo " +
      MujocoVersion() + ", " + std::to_string(executions_[0] + executions_[1]) +
      " executions.\n  Grasps are planned anew on each side, at the trial's friction: these are "
      "the grasps of the tables.\n\nBoth sides of a pair meet equal random draws. Means over "
      "pairs, 95 % intervals:\n\n" +
      Means();
  text +=
      "\n## Splits\n\nBy object, drawn from the seed: both sides of an object, and all its "
      "grasps, are in one split. Objects of one family\n(samples of one generator) are not kept "
      "apart.\n\n";
  for (const std::string& sentence : EmptySplits()) text += "There is " + sentence + ".\n\n";
  text +=
      "## Uses\n\nLabels are a simulation's, of one gripper (`metric.toml`). A policy that is "
      "trained on them should be tested on\nobjects of another source, and on a robot.\n\n";
  text += "## Licence\n\n" +
          (request_.license.empty() ? "Not stated: fill in before you share this set. Meshes keep "
                                      "the licence of their source."
                                    : request_.license) +
          "\n";
  return text;
}

}  // namespace antigrasp
