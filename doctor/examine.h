#pragma once

#include <functional>
#include <string>

#include "antigrasp/core/child_process.h"
#include "antigrasp/core/observer.h"

namespace antigrasp {

// Exit code of ExamineNetworks' process that says so.
inline constexpr int kOtherBytes = 3;

using PrintFn = std::function<void(const std::string& lines)>;
// On standard output, at once: another process prints there next.
void PrintNow(const std::string& lines);

// `antigrasp doctor`: prints BuildFacts and what RunSelfTest found, then, in a build with networks,
// lets `networks` run ExamineNetworks in a process of its own, which may not even start.
// RuntimeFailure in the end when bytes differ or that process failed.
void Examine(const PrintFn& print, const std::function<ChildEnd()>& networks,
             RunObserver* observer);

}  // namespace antigrasp
