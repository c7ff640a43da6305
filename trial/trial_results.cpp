#include "antigrasp/trial/trial_results.h"

#include <algorithm>
#include <fstream>
#include <utility>

#include "antigrasp/core/error.h"
#include "antigrasp/core/options.h"
#include "antigrasp/core/rng.h"
#include "antigrasp/core/version.h"

namespace antigrasp {
namespace {

namespace fs = std::filesystem;

const ResultFiles kTrialFiles = {
    "trials.csv", {"executions.csv", "means.csv", "replays.json", "trial.toml"}, {}};
constexpr const char *kConstants = "trial.toml", *kExecutions = "executions.csv",
                     *kReplays = "replays.json";
constexpr const char* kUnfinished = "\n[unfinished]\n";  // behind them

void Bind(OptionTable* table, Unfinished* unfinished) {
  table->Add("unfinished.done", &unfinished->done, "trials; the same call goes on");
  table->Add("unfinished.of", &unfinished->of, "trials that the call has to make");
  table->Add("unfinished.meshes", &unfinished->meshes, "hash of those tried");
  table->Add("unfinished.replays", &unfinished->replays, "of an object");
  table->Add("unfinished.tables", &unfinished->tables, "hash of the files beside this one");
  table->Add("unfinished.program", &unfinished->program, {}, "that made them");
}

// The part of a saved trial.toml that a finished one has.
std::string ConstantsOf(const std::string& toml) { return toml.substr(0, toml.find(kUnfinished)); }

// In pieces: a file may be larger than memory.
template <class Take>
void ReadPieces(const fs::path& from, std::uintmax_t bytes, const Take& take) {
  std::ifstream in(from, std::ios::binary);
  std::string piece;
  for (std::uintmax_t left = bytes; left > 0; left -= piece.size()) {
    piece.resize(static_cast<std::size_t>(std::min<std::uintmax_t>(left, 1 << 20)));
    if (!in.read(piece.data(), std::ssize(piece))) {
      throw InputError("is cut short", from.string(), "what an interrupted call wrote");
    }
    take(piece);
  }
}

std::uint64_t TablesHash(const std::string& trials, const fs::path& executions,
                         const fs::path& replays) {
  std::uint64_t hash = HashOf(trials);
  for (const fs::path& file : {executions, replays}) {
    ReadPieces(file, fs::file_size(file), [&](const std::string& piece) {
      hash = HashOf(std::to_string(hash) + " " + piece);
    });
  }
  return hash >> 1;  // TOML's own
}

void AppendFile(const fs::path& from, std::uintmax_t bytes, AtomicFile* to) {
  ReadPieces(from, bytes, [&](const std::string& piece) { to->Append(piece); });
}

}  // namespace

std::optional<Unfinished> ReadUnfinished(const fs::path& folder) {
  if (!fs::is_regular_file(folder / kConstants)) return std::nullopt;
  const std::string toml = ReadFile(folder / kConstants);
  const std::size_t at = toml.find(kUnfinished);
  if (at == std::string::npos) return std::nullopt;
  Unfinished unfinished;
  OptionTable table;
  Bind(&table, &unfinished);
  table.ApplyText(toml.substr(at), (folder / kConstants).string());
  return unfinished;
}

TrialResults::TrialResults(const PhysicsTrialRequest& request, const Protocol& protocol,
                           const ObjectSource& objects, std::string constants, std::uint64_t of)
    : out_(request.out),
      constants_(std::move(constants)),
      unfinished_{0, of,
                  0, static_cast<std::uint64_t>(request.replays),
                  0, ProgramVersion() + " " + ProgramCommit()},
      trials_(protocol) {
  if (out_.empty()) return;
  const auto begun = request.overwrite ? std::nullopt : ReadUnfinished(out_);
  if (begun) {
    if (begun->program != unfinished_.program) {
      throw InputError(
          "holds an interrupted trial of antigrasp " + begun->program, request.out,
          "that version (this is " + unfinished_.program + "), a new folder, or --overwrite");
    }
    if (begun->of != of) {
      throw InputError("holds an interrupted trial of other objects", request.out,
                       std::to_string(begun->of) + " trials of an object, not " +
                           std::to_string(of) + ", a new folder, or --overwrite");
    }
    if (begun->replays != unfinished_.replays ||
        ConstantsOf(ReadFile(out_ / kConstants)) != constants_) {
      throw InputError("holds an interrupted trial of other settings", request.out,
                       "the settings that it began with, a new folder, or --overwrite");
    }
    const fs::path trials = out_ / kTrialFiles.table, executions = out_ / kExecutions,
                   replays = out_ / kReplays;
    for (const fs::path& file : {trials, executions, replays}) {
      RequireFile(file, "as the trial left it");
    }
    if (TablesHash(ReadFile(trials), executions, replays) != begun->tables) {
      throw InputError("holds an interrupted trial whose tables were changed", request.out,
                       "trials.csv, executions.csv and replays.json as the trial left them, a new "
                       "folder, or --overwrite");
    }
    done_ = ReadTrialRows(trials, protocol);
    meshes_of_done_ = begun->meshes;
  }
  folder_.emplace(out_, kTrialFiles, objects, request.overwrite || begun.has_value());
  executions_file_.emplace(folder_->path() / kExecutions);
  replays_file_.emplace(folder_->path() / kReplays);
  if (begun) GoOn();
}

void TrialResults::GoOn() {
  const fs::path executions = out_ / kExecutions, replays = out_ / kReplays;
  AppendFile(executions, fs::file_size(executions), &*executions_file_);
  executions_.TakeText();  // the header is there
  const std::uintmax_t size = fs::file_size(replays),
                       end = ReplayFile().EndText().size() - ReplayFile().TakeText().size();
  const std::uintmax_t kept = size - std::min(size, end);
  AppendFile(replays, kept, &*replays_file_);
  replays_.GoOnBehind(kept);
}

void TrialResults::Add(const TrialRun& run, const TrialSummary& summary, const PhysicsTrial* trial,
                       const std::vector<std::string>& replays, std::uint64_t mesh) {
  trials_.Add(run, summary);
  Unfinished& now = unfinished_;
  now.meshes = HashOf(std::to_string(now.meshes) + " " + std::to_string(mesh)) >> 1;  // TOML's own
  if (++now.done == done_.size() && now.meshes != meshes_of_done_) {
    throw InputError("holds an interrupted trial of other objects", out_.string(),
                     "the objects that it began with, a new folder, or --overwrite");
  }
  if (trial == nullptr || !executions_file_) return;
  executions_.Add(run, summary.object, *trial);
  executions_file_->Append(executions_.TakeText());
  for (const std::string& replay : replays) replays_.Add(replay);
  replays_file_->Append(replays_.TakeText());
}

void TrialResults::Commit() {
  if (!folder_) return;
  executions_file_->Append(executions_.TakeText());  // the header, where nothing was executed
  executions_file_->Commit();
  replays_file_->Append(replays_.EndText());
  replays_file_->Commit();
  WriteFileAtomic(folder_->path() / "means.csv", means_.text());
  std::string toml = constants_;
  if (!finished()) {
    unfinished_.tables =
        TablesHash(trials_.text(), folder_->path() / kExecutions, folder_->path() / kReplays);
    OptionTable table;
    Bind(&table, &unfinished_);
    toml += "\n" + table.Dump();
  }
  WriteFileAtomic(folder_->path() / kConstants, toml);
  folder_->Commit(trials_.text());
}

}  // namespace antigrasp
