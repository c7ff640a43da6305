#pragma once

#include <optional>
#include <string>
#include <vector>

#include "antigrasp/quality/grasp_table.h"
#include "antigrasp/quality/judge.h"
#include "antigrasp/quality/known_scores.h"
#include "antigrasp/quality/object_size.h"
#include "antigrasp/quality/score_text.h"
#include "antigrasp/quality/scored_object.h"

namespace antigrasp {

// What is kept of the objects of a set when they have been scored one by one, and what is said of
// them all. Some hundred bytes an object.
class ScoredSet {
 public:
  // `egad`: with EGAD's score in every row.
  explicit ScoredSet(const MetricOptions& metric, bool egad = false)
      : metric_(metric), egad_(egad), known_(KnownSetsAt(metric)), sizes_(metric) {}
  // In the order of the set; its row of scores.csv comes back. With the original of every object,
  // before a change, or of none. Behind the other columns of the row stands of how many percent of
  // each known set the object is harder to grasp; a gap without a grasp.
  ScoreRow Add(const ScoredObject& scored, const ScoredObject* original = nullptr);
  // A sentence of which somebody is to be warned, in the order added.
  void AddNote(std::string note) { notes_.push_back(std::move(note)); }

  // What a judge said of an object, too.
  void AddVerdict(const Verdict& verdict) { verdicts_.Add(verdict); }
  const VerdictCount& verdicts() const { return verdicts_; }
  // Why a judge scored no more; the first time it counts. Empty: it went on.
  void JudgeStopped(const std::string& why) { stopped_ = stopped_.empty() ? why : stopped_; }
  const std::string& stopped() const { return stopped_; }

  // A line for the end of the summary.
  void AddLine(std::string line) { lines_.push_back(std::move(line)); }

  // InputError, naming the first object's status, when none has a score.
  void RequireAScore(const std::string& where) const;
  std::vector<std::string> Warnings() const;  // notes and what UnlikelySizes finds
  // How many, their mean and what became of the candidates; of an only one the interval; how many
  // grasps it took, unless `effort_given`; which objects offer no grasp; the others beside known
  // sets.
  std::vector<std::string> Summary(bool effort_given) const;
  std::string PairedDifference() const;  // with originals

 private:
  MetricOptions metric_;
  bool egad_;
  std::vector<const KnownSet*> known_;
  std::string first_;                       // the first one and its status
  std::vector<double> values_, originals_;  // graspabilities, NaN where there is none
  std::vector<double> with_grasps_;         // those of values_ that are not 0 for want of a grasp
  std::vector<std::string> no_grasps_;
  std::vector<std::string> notes_, lines_;
  VerdictCount verdicts_;
  std::string stopped_;
  CandidateCount candidates_;
  UnlikelySizes sizes_;
  // Of an only object, and of an only pair: what its grasps say about how sure its numbers are.
  std::string interval_;
  std::optional<PairDifference> pair_;
};

}  // namespace antigrasp
