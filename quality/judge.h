#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "antigrasp/core/options.h"
#include "antigrasp/core/word_count.h"
#include "antigrasp/mesh/triangle_mesh.h"

// Whoever scores objects: the metric, a trial in physics, a program of somebody else. What scores
// objects drives tables, searches and loops alike; who stands behind it is made in the room `judge`
// (judge/make_judge.h).
namespace antigrasp {

// An object as a judge is shown it.
struct JudgedObject {
  std::string name;
  const TriangleMesh* mesh = nullptr;  // a closed solid in its own unit; not kept
  std::uint64_t stream = 0;            // of its random draws: equal before and after a change
};

// A finite score, or none and why. Lower: harder to grasp.
struct Verdict {
  std::optional<double> score;
  std::string status = kOk;  // kOk exactly with a score; else words that are counted

  static constexpr const char* kOk = "ok";
  static Verdict Of(double score);  // without a score for a number that is not finite
  static Verdict None(std::string why) { return {std::nullopt, std::move(why)}; }
};

// Not thread-safe: a judge of a batch uses threads of its own.
class Judge {
 public:
  virtual ~Judge() = default;
  // What it is asked by: "epsilon", "trial:six-ways", the command.
  virtual std::string Name() const = 0;
  // Its name and what it was set to, as TOML under [judge]: belongs beside its scores.
  std::string Toml() const;
  // One verdict an object, in their order, the same for any number of threads. Objects of a batch
  // may be judged side by side; a caller who has many asks in batches of BatchSize().
  virtual std::vector<Verdict> Score(const std::vector<JudgedObject>& objects) = 0;
  virtual std::size_t BatchSize() const { return 32; }
  // Why it scores no more: everything still to come gets no score. Empty: it goes on.
  virtual std::string Stopped() const { return ""; }
  // What happened on the way, for people: "started again 2 times".
  virtual std::vector<std::string> Notes() const { return {}; }

 protected:
  // Calls `add` with a table of its settings, which need not live longer.
  virtual void TellSettings(const std::function<void(const OptionTable&)>& /*add*/) const {}
};

// "12 scored, 2 late, 1 no score", of verdicts that come one by one.
class VerdictCount {
 public:
  void Add(const Verdict& verdict);
  std::string Text() const;
  int scored() const { return scored_; }

 private:
  int scored_ = 0;
  WordCount without_;
};

}  // namespace antigrasp
