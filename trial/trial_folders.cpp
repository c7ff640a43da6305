#include "antigrasp/trial/trial_folders.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <tuple>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/csv_reader.h"
#include "antigrasp/core/error.h"
#include "antigrasp/core/format.h"
#include "antigrasp/trial/physics_trial.h"
#include "antigrasp/trial/trial_results.h"

namespace antigrasp {
namespace {

std::string Millimetres(double metres) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", 1000.0 * metres);
  return text;
}

std::string TipInWords(const Fingertip& tip) {
  if (tip.shape == TipShape::kSphere) return "sphere of " + Millimetres(tip.radius) + " mm";
  return "pad of " + Millimetres(tip.pad_width) + " x " + Millimetres(tip.pad_height) + " mm";
}

TrialJudge ReadJudge(const std::filesystem::path& path) {
  RequireFile(path, "trial.toml of antigrasp trial --out FOLDER");
  TrialJudge judge;
  PhysicsTrialOptions options;
  OptionTable table;
  Bind(&table, &options);
  table.Add("engine", &judge.engine, {}, "who judged");
  table.Add("equal_mass", &judge.equal_mass, 0.0, 1e6, "kg");
  table.ApplyKnown(ReadFile(path), path.string(), "engine");
  if (judge.engine.empty()) throw InputError("no engine", path.string(), "engine = \"mujoco ...\"");
  judge.tip = TipInWords(options.physics.tip);
  if (options.mass > 0.0) judge.equal_mass = options.mass;
  return judge;
}

void RequireSame(const std::string& what, const std::string& value, const std::string& of_first,
                 const std::string& where) {
  if (value == of_first) return;
  throw InputError(what + " " + value, where, of_first + ", as in the first folder");
}

// What all folders are of one judge by; an equal mass counts where there are rows of it.
void Join(const TrialJudge& judge, const std::string& where, TrialJudge* all) {
  if (all->engine.empty()) {
    *all = judge;
    return;
  }
  RequireSame("engine", judge.engine, all->engine, where);
  RequireSame("protocol", judge.protocol, all->protocol, where);
  RequireSame("fingertip", judge.tip, all->tip, where);
  if (all->equal_mass == 0.0) all->equal_mass = judge.equal_mass;
  if (judge.equal_mass == 0.0) return;
  RequireSame("equal mass, kg:", FormatDouble(judge.equal_mass), FormatDouble(all->equal_mass),
              where);
}

// How far an interrupted call came; "" of one that ended.
std::string HowFar(const std::string& folder) {
  const auto unfinished = ReadUnfinished(folder);
  if (!unfinished) return "";
  return "interrupted after " + std::to_string(unfinished->done) + " of " +
         std::to_string(unfinished->of) + " trials of an object";
}

bool HasMeans(const std::string& folder) {
  const std::filesystem::path path = std::filesystem::path(folder) / "means.csv";
  RequireFile(path, "means.csv of antigrasp trial --out FOLDER");
  return CsvReader(path).Next();
}

}  // namespace

TriedFolders ReadTrialFolders(const std::vector<std::string>& folders) {
  TriedFolders all;
  std::map<std::tuple<std::string, double, std::string>, std::string> tried;  // in which folder
  for (const std::string& folder : folders) {
    const std::filesystem::path path = std::filesystem::path(folder) / "means.csv";
    if (const std::string how_far = HowFar(folder); !HasMeans(folder) && !how_far.empty()) {
      throw InputError(how_far + ", before there was a mean", folder,
                       "the same call of antigrasp trial again, to its end");
    }
    std::vector<TrialMean> rows = ReadTrialMeans(path);
    TrialJudge judge = ReadJudge(std::filesystem::path(folder) / "trial.toml");
    judge.protocol = rows.front().protocol;
    std::erase_if(rows, [](const TrialMean& row) { return row.grasps != "all"; });
    if (std::none_of(rows.begin(), rows.end(),
                     [](const TrialMean& row) { return row.masses == "equal"; })) {
      judge.equal_mass = 0.0;
    }
    Join(judge, folder, &all.judge);
    for (TrialMean& row : rows) {
      RequireSame("protocol", row.protocol, all.judge.protocol, path.string());
      const auto [found, is_new] =
          tried.emplace(std::tuple(row.masses, row.friction, row.stage), folder);
      if (!is_new) {
        throw InputError(
            "friction " + FormatDouble(row.friction) + ", " + row.masses + " mass once more",
            path.string(), "each friction once; it is in " + found->second + ", too");
      }
      all.rows.push_back(std::move(row));
    }
  }
  return all;
}

std::string TrialFolderText(const std::string& folder) {
  const std::string how_far = HowFar(folder);
  if (!how_far.empty() && !HasMeans(folder)) {
    return folder + ": trials, " + how_far + "; no means yet\n";
  }
  const TriedFolders tried = ReadTrialFolders({folder});
  const TrialJudge& judge = tried.judge;
  std::string text = folder + ": trials, " + judge.protocol + ", fingertip " + judge.tip + ", " +
                     judge.engine + "\n";
  if (!how_far.empty()) text += "  " + how_far + "\n";
  for (const TrialMean& row : tried.rows) {
    text += "  friction " + FormatDouble(row.friction) + ", " + row.masses + " mass, " + row.stage +
            ": held " + MeanText(row.held, 1) + " % (" + std::to_string(row.held.count) +
            " objects)";
    if (row.difference.count > 0) {
      text += ", before " + MeanText(row.before, 1) + ", difference " +
              MeanText(row.difference, 1) + " points (" + std::to_string(row.difference.count) +
              " pairs)";
    }
    text += "\n";
  }
  return text;
}

}  // namespace antigrasp
