#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/datasets/result_folder.h"
#include "antigrasp/trial/object_trials.h"
#include "antigrasp/trial/replay_file.h"
#include "antigrasp/trial/trials_csv.h"

namespace antigrasp {

// How far an interrupted call came, of the trials that it had to make: of an object on one side, at
// one mass and friction each.
struct Unfinished {
  std::uint64_t done = 0, of = 0;
  std::uint64_t meshes = 0;   // a hash of what was tried
  std::uint64_t replays = 0;  // of an object, as asked for
  std::uint64_t tables = 0;   // a hash of the files that it left
  std::string program;        // which made them
};
// Of a folder that a call of `trial` left; nullopt: there is none, or it is finished.
std::optional<Unfinished> ReadUnfinished(const std::filesystem::path& folder);

// The tables of a call of `trial`, which grow trial by trial, in a folder if there is one. An
// interrupted call leaves it as far as it came, and the next one of the same settings goes on.
class TrialResults {
 public:
  // `constants`: trial.toml. `of`: trials to make. InputError as ResultFolder, and for a folder of
  // an interrupted call of other settings, unless it may be overwritten.
  TrialResults(const PhysicsTrialRequest& request, const Protocol& protocol,
               const ObjectSource& objects, std::string constants, std::uint64_t of);

  // What is done already, in the order in which trials are made.
  const std::vector<TrialRow>& done() const { return done_; }
  // `trial`: nullptr for one of done(). `mesh`: a hash of what was tried. InputError when what was
  // done was done with other meshes.
  void Add(const TrialRun& run, const TrialSummary& summary, const PhysicsTrial* trial,
           const std::vector<std::string>& replays, std::uint64_t mesh);
  MeansTable* means() { return &means_; }
  std::uint64_t added() const { return unfinished_.done; }
  bool finished() const { return unfinished_.done == unfinished_.of; }
  // Fills the folder, if there is one.
  void Commit();

 private:
  void GoOn();

  std::filesystem::path out_;
  std::string constants_;
  Unfinished unfinished_;  // as it stands now
  std::uint64_t meshes_of_done_ = 0;
  std::vector<TrialRow> done_;
  TrialsTable trials_;
  ExecutionsTable executions_;
  MeansTable means_;
  ReplayFile replays_;
  std::optional<ResultFolder> folder_;
  std::optional<AtomicFile> executions_file_, replays_file_;  // which grow with every object
};

}  // namespace antigrasp
