#include "antigrasp/judge/score_objects.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "antigrasp/core/error.h"
#include "antigrasp/core/shared_stream.h"
#include "antigrasp/mesh/pass_mesh.h"
#include "antigrasp/quality/pass_scores.h"
#include "antigrasp/quality/sampling_effort.h"

namespace antigrasp {
namespace {

// An object scored by the metric.
struct Item {
  ScoredObject scored;
  std::optional<ScoredObject> original;
  bool usable = false;
  TriangleMesh mesh;  // of a usable object, until it is judged
};
void PassFields(Passer& pass, Item& item) {
  pass(item.scored, item.original, item.usable, item.mesh);
}

// Neighbours that were judged together, and the judge after them.
struct JudgedItems {
  std::vector<Item> items;
  std::vector<Verdict> verdicts;  // one each
  std::string stopped;
  std::vector<std::string> notes;
  int rank = 0;  // whose judge it was
};
void PassFields(Passer& pass, JudgedItems& judged) {
  pass(judged.items, judged.verdicts, judged.stopped, judged.notes, judged.rank);
}

class Scorer {
 public:
  Scorer(const ObjectSource& objects, const ObjectSource* originals,
         const std::vector<std::int64_t>& original_of, const Scoring& scoring)
      : objects_(objects), originals_(originals), original_of_(original_of), scoring_(scoring) {}

  Item Score(std::int64_t i) const {
    const std::uint64_t stream = objects_.stream(i);
    Item item;
    if (originals_ != nullptr) {
      const std::int64_t place = original_of_[static_cast<std::size_t>(i)];
      item.original = ScoreObject(originals_->Load(place), stream, scoring_);
    }
    InputObject object = objects_.Load(i);
    item.scored = ScoreObject(object, stream, scoring_);
    item.usable = object.ok();
    if (scoring_.judge != nullptr && item.usable) item.mesh = std::move(object.mesh);
    return item;
  }

  // `first`: of these.
  JudgedItems Judge(std::int64_t first, std::vector<Item> items) const {
    JudgedItems judged;
    std::vector<JudgedObject> shown;
    for (std::size_t k = 0; k < items.size(); ++k) {
      const std::int64_t i = first + static_cast<std::int64_t>(k);
      if (!items[k].usable) continue;
      shown.push_back({objects_.name(i), &items[k].mesh, objects_.stream(i)});
    }
    const std::vector<Verdict> verdicts = scoring_.judge->Score(shown);
    auto next = verdicts.begin();
    for (Item& item : items) {
      judged.verdicts.push_back(item.usable ? *next++ : Verdict::None(item.scored.status));
      item.mesh = {};
    }
    judged.items = std::move(items);
    judged.stopped = scoring_.judge->Stopped();
    judged.notes = scoring_.judge->Notes();
    return judged;
  }

 private:
  const ObjectSource& objects_;
  const ObjectSource* originals_;
  const std::vector<std::int64_t>& original_of_;
  const Scoring& scoring_;
};

// What has been scored, in the order of the set.
class Rows {
 public:
  Rows(const Scorer& scorer, const Scoring& scoring, const TakeScored& take, ScoredSet* set)
      : scorer_(scorer), scoring_(scoring), take_(take), set_(*set) {}

  // Waits for the judge: a batch's meshes are all that is kept of a set.
  void Add(std::int64_t place, Item item, bool last) {
    if (scoring_.judge == nullptr) return take_(item.scored, RowOf(item));
    waiting_.push_back(std::move(item));
    if (!last && waiting_.size() < scoring_.judge->BatchSize()) return;
    const std::int64_t first = place + 1 - std::ssize(waiting_);
    Add(scorer_.Judge(first, std::exchange(waiting_, {})));
  }

  void Add(const JudgedItems& judged) {
    for (std::size_t k = 0; k < judged.items.size(); ++k) {
      const Verdict& verdict = judged.verdicts[k];
      ScoreRow row = RowOf(judged.items[k]);
      if (judged.items[k].usable) set_.AddVerdict(verdict);
      scores_.push_back(verdict.score.value_or(std::nan("")));
      row.extras.emplace_back("judge", scores_.back());
      row.texts.emplace_back("judge_status", verdict.status);
      take_(judged.items[k].scored, row);
    }
    set_.JudgeStopped(judged.stopped);
    notes_[judged.rank] = judged.notes;
  }

  // What is said of the judge.
  void Finish() {
    if (scoring_.judge == nullptr) return;
    const MeanInterval mean = MeanWithInterval(scores_);
    set_.AddLine("judge " + scoring_.judge->Name() + ": " + set_.verdicts().Text() +
                 (mean.count > 0 ? ", mean " + MeanText(mean, 5) : ""));
    for (const auto& [rank, notes] : notes_) {
      const std::string of = rank == 0 ? "judge: " : "judge of rank " + std::to_string(rank) + ": ";
      for (const std::string& note : notes) scoring_.warn(of + note);
    }
  }

 private:
  ScoreRow RowOf(const Item& item) {
    return set_.Add(item.scored, item.original ? &*item.original : nullptr);
  }

  const Scorer& scorer_;
  const Scoring& scoring_;
  const TakeScored& take_;
  ScoredSet& set_;
  std::vector<Item> waiting_;
  std::vector<double> scores_;
  std::map<int, std::vector<std::string>> notes_;  // by rank
};

// Objects one by one; judged by rank 0 as they come, or, where there are several ranks, by each in
// batches of its own.
void StreamScored(const Scorer& scorer, std::int64_t count, const Scoring& scoring, Rows* rows) {
  const ProgressFn progress = scoring.observer->Phase("scoring");
  WorkShare* const share = scoring.share;
  if (share == nullptr || scoring.judge == nullptr) {
    StreamShared(
        share, count, scoring.threads, [&](std::int64_t i) { return scorer.Score(i); },
        [&](std::int64_t i, Item item) { rows->Add(i, std::move(item), i + 1 == count); },
        progress);
    return;
  }
  const auto most = static_cast<std::int64_t>(scoring.judge->BatchSize());
  const std::int64_t batch = std::max<std::int64_t>(1, std::min(most, count / (8 * share->size())));
  StreamShared(
      share, (count + batch - 1) / batch, 1,
      [&](std::int64_t b) {
        std::vector<Item> items(static_cast<std::size_t>(std::min(batch, count - b * batch)));
        ParallelFor(std::ssize(items), scoring.threads, [&](std::int64_t k) {
          items[static_cast<std::size_t>(k)] = scorer.Score(b * batch + k);
        });
        JudgedItems judged = scorer.Judge(b * batch, std::move(items));
        judged.rank = share->rank();
        return judged;
      },
      [&](std::int64_t, const JudgedItems& judged) { rows->Add(judged); },
      [&](std::int64_t done, std::int64_t) { progress(std::min(done * batch, count), count); });
}

}  // namespace

ScoredObject ScoreObject(const InputObject& object, std::uint64_t stream, const Scoring& scoring) {
  ScoredObject scored =
      ScoreObject(object.name, object.status, object.mesh, stream, scoring.metric, scoring.seed);
  scored.note = object.note;
  return scored;
}

ScoredSet ScoreObjects(const ObjectSource& objects, const std::string& where,
                       const ObjectSource* originals, const std::vector<std::int64_t>& original_of,
                       const Scoring& scoring, const TakeScored& take) {
  ScoredSet set(scoring.metric, scoring.egad);
  const Scorer scorer(objects, originals, original_of, scoring);
  Rows rows(scorer, scoring, take, &set);
  StreamScored(scorer, objects.size(), scoring, &rows);
  if (Helps(scoring.share)) return set;
  const std::string shared = SharedDrawsText(objects.streams());
  if (!shared.empty()) set.AddNote(shared);
  for (const std::string& warning : set.Warnings()) scoring.warn(warning);
  rows.Finish();
  set.RequireAScore(where);
  return set;
}

void RequireAVerdict(const ScoredSet& set, const Judge* judge) {
  if (judge == nullptr) return;
  if (!set.stopped().empty()) throw RuntimeFailure("the judge stopped: " + set.stopped());
  if (set.verdicts().scored() > 0) return;
  throw InputError("the judge scored no object: " + set.verdicts().Text(),
                   "--judge " + judge->Name(), "a finite score of at least one");
}

namespace {

// `places`: rank 0's, who tells the others.
std::vector<Graspability> ScoreAgain(const ObjectSource& objects, std::vector<std::int64_t> places,
                                     const Scoring& scoring) {
  TellAll(scoring.share, &places);
  std::vector<Graspability> scores;
  StreamShared(
      scoring.share, std::ssize(places), scoring.threads,
      [&](std::int64_t k) {
        const std::int64_t place = places[static_cast<std::size_t>(k)];
        return ScoreObject(objects.Load(place), objects.stream(place), scoring).score;
      },
      [&](std::int64_t, Graspability score) { scores.push_back(std::move(score)); },
      scoring.observer->Phase("scoring the hardest again"));
  return scores;
}

}  // namespace

HardestOfSet FindHardest(const ObjectSource& objects, const std::string& where, int count,
                         const Scoring& scoring) {
  std::vector<ScoreRow> rows;
  const ScoredSet set =
      ScoreObjects(objects, where, nullptr, {}, scoring,
                   [&](const ScoredObject&, const ScoreRow& row) { rows.push_back(row); });
  for (const ScoreRow& row : rows) {
    if (!row.score) scoring.warn("not scored: " + row.object + ": " + row.status);
  }
  Scoring fresh = scoring;
  fresh.seed = FreshSeed(scoring.seed);
  if (!scoring.effort_given) RaiseEffortForFew(1, &fresh.metric);
  if (Helps(scoring.share)) {
    ScoreAgain(objects, {}, fresh);
    return {};
  }
  HardestOfSet found{FindHardest(std::move(rows), count,
                                 [&](const std::vector<std::int64_t>& places) {
                                   return ScoreAgain(objects, places, fresh);
                                 }),
                     set.Summary(scoring.effort_given)};
  if (found.objects.empty()) {
    throw InputError("no object has a grasp; " + FirstNames(found.no_grasps), where,
                     "objects that the gripper can hold");
  }
  const int grasps = fresh.metric.num_grasps;
  for (std::string& line : HardestText(found, grasps > scoring.metric.num_grasps ? grasps : 0)) {
    found.summary.push_back(std::move(line));
  }
  return found;
}

}  // namespace antigrasp
