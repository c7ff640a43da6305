#pragma once

#include <functional>
#include <string>
#include <vector>

#include "antigrasp/core/work_share.h"

namespace antigrasp {

// A command whose loops are shared, as whatever the environment or `processes` says: alone (`run`
// gets nullptr), or as a rank of a job. InputError where the ranks were not called alike
// (SameCall). `pause`: as for JoinRanks (job.h).
void RunShared(int processes, const std::function<void()>& pause, const SharedRun& run);

// What the calls of all ranks must have alike (JoinOptions::same), a line each: the program, every
// option with its values, and of every file and folder that is named what it holds: names and
// sizes, and the bytes of a small file. `words`: the program's name, then what it was called with.
// Left out: what only rank 0 writes (--out, --report), and how each rank works (--threads,
// --processes).
std::vector<std::string> SameCall(const std::vector<std::string>& words);

}  // namespace antigrasp
