#include "antigrasp/judge/score_objects.h"

#include <cmath>
#include <optional>
#include <utility>

#include "antigrasp/core/error.h"
#include "antigrasp/core/ordered_stream.h"
#include "antigrasp/quality/sampling_effort.h"

namespace antigrasp {
namespace {

// Scored by the metric, waiting for the judge: a batch's meshes are all that is kept of a set.
class JudgedRows {
 public:
  JudgedRows(const ObjectSource& objects, Judge* judge, const TakeScored& take, ScoredSet* set)
      : objects_(objects), judge_(judge), take_(take), set_(*set) {}

  void Add(std::int64_t place, ScoredObject scored, ScoreRow row, TriangleMesh mesh) {
    if (judge_ == nullptr) return take_(scored, row);
    waiting_.push_back({place, std::move(scored), std::move(row), std::move(mesh)});
    if (waiting_.size() >= judge_->BatchSize()) Flush();
  }

  void Flush() {
    std::vector<JudgedObject> shown;
    for (const Waiting& one : waiting_) {
      if (Usable(one)) {
        shown.push_back({objects_.name(one.place), &one.mesh, objects_.stream(one.place)});
      }
    }
    if (waiting_.empty()) return;
    const std::vector<Verdict> verdicts = judge_->Score(shown);
    auto next = verdicts.begin();
    for (Waiting& one : waiting_) {
      const Verdict verdict = Usable(one) ? *next++ : Verdict::None(one.scored.status);
      if (Usable(one)) set_.AddVerdict(verdict);
      scores_.push_back(verdict.score.value_or(std::nan("")));
      one.row.extras.emplace_back("judge", scores_.back());
      one.row.texts.emplace_back("judge_status", verdict.status);
      take_(one.scored, one.row);
    }
    waiting_.clear();
  }

  // "judge NAME: 12 scored, 1 late, mean 0.71 +-0.05 (95 %)".
  std::string Text() const {
    const MeanInterval mean = MeanWithInterval(scores_);
    return "judge " + judge_->Name() + ": " + set_.verdicts().Text() +
           (mean.count > 0 ? ", mean " + MeanText(mean, 5) : "");
  }

 private:
  struct Waiting {
    std::int64_t place;
    ScoredObject scored;
    ScoreRow row;
    TriangleMesh mesh;
  };
  static bool Usable(const Waiting& one) { return !one.mesh.faces.empty(); }

  const ObjectSource& objects_;
  Judge* judge_;
  const TakeScored& take_;
  ScoredSet& set_;
  std::vector<Waiting> waiting_;
  std::vector<double> scores_;
};

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
  struct Item {
    ScoredObject scored;
    std::optional<ScoredObject> original;
    TriangleMesh mesh;  // for the judge, of a usable object
  };
  ScoredSet set(scoring.metric, scoring.egad);
  JudgedRows rows(objects, scoring.judge, take, &set);
  StreamInOrder(
      objects.size(), scoring.threads,
      [&](std::int64_t i) {
        const std::uint64_t stream = objects.stream(i);
        Item item;
        if (originals != nullptr) {
          const std::int64_t place = original_of[static_cast<std::size_t>(i)];
          item.original = ScoreObject(originals->Load(place), stream, scoring);
        }
        InputObject object = objects.Load(i);
        item.scored = ScoreObject(object, stream, scoring);
        if (scoring.judge != nullptr && object.ok()) item.mesh = std::move(object.mesh);
        return item;
      },
      [&](std::int64_t i, Item item) {
        ScoreRow row = set.Add(item.scored, item.original ? &*item.original : nullptr);
        rows.Add(i, std::move(item.scored), std::move(row), std::move(item.mesh));
        if (i + 1 == objects.size()) rows.Flush();
      },
      scoring.observer->Phase("scoring"));
  const std::string shared = SharedDrawsText(objects.streams());
  if (!shared.empty()) set.AddNote(shared);
  for (const std::string& warning : set.Warnings()) scoring.warn(warning);
  if (scoring.judge != nullptr) {
    set.AddLine(rows.Text());
    for (const std::string& note : scoring.judge->Notes()) scoring.warn("judge: " + note);
  }
  set.RequireAScore(where);
  return set;
}

void RequireAVerdict(const ScoredSet& set, const Judge* judge) {
  if (judge == nullptr) return;
  if (!judge->Stopped().empty()) throw RuntimeFailure("the judge stopped: " + judge->Stopped());
  if (set.verdicts().scored() > 0) return;
  throw InputError("the judge scored no object: " + set.verdicts().Text(),
                   "--judge " + judge->Name(), "a finite score of at least one");
}

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
  HardestOfSet found{
      FindHardest(
          std::move(rows), count,
          [&](std::int64_t place) {
            return ScoreObject(objects.Load(place), objects.stream(place), fresh).score;
          },
          scoring.threads, scoring.observer->Phase("scoring the hardest again")),
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
