#pragma once

#include <functional>
#include <string>

#include "antigrasp/core/options.h"
#include "antigrasp/perturb/judge_pool.h"
#include "antigrasp/perturb/judged_search.h"
#include "antigrasp/perturb/scored_perturbation.h"
#include "antigrasp/perturb/search.h"

namespace antigrasp {

// The two searches, by what they minimise.
struct SearchChoice {
  std::string objective = "epsilon";  // PerturbBySearch; a judge else (judge/make_judge.h)
  SearchOptions descent;
  JudgedSearchOptions judged;
};
void Bind(OptionTable* table, SearchChoice* choice);      // everything, keys "search.*"
void BindUsed(OptionTable* table, SearchChoice* choice);  // what its objective makes use of

// InputError for an option that the objective makes no use of. `typed`: what was given for a key,
// as it was typed; empty when it was not.
void RequireUsed(const SearchChoice& choice,
                 const std::function<std::string(const std::string& key)>& typed);

// Makes the search the method of the settings, whose metric and seed are set. On a judge: searched
// with few grasps an object, and both meshes judged with the metric's own number under the draws of
// settings->seed, which the search has not seen; a trial so says what `antigrasp trial` says of
// them at equal mass. `threads` of one object (0 = all). `make`: makes a judge
// of somebody's own, in the place of the one that the objective names. InputError as MakeJudge.
void UseSearch(const SearchChoice& choice, int threads, PerturbSettings* settings,
               const JudgePool::Maker& make = nullptr);

}  // namespace antigrasp
