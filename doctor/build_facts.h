#pragma once

#include <string>

namespace antigrasp {

// A line of what `antigrasp doctor` prints: "threads           2".
std::string FactLine(const std::string& what, const std::string& found);

// What this build is and has, and why not, and where it runs: version, system, compiler, libraries,
// instruction set, threads, physics, report, formats, networks; a line each.
std::string BuildFacts();

// Whether `antigrasp-networks` was built beside it.
bool BuiltWithNetworks();

}  // namespace antigrasp
