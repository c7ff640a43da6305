#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace antigrasp {

// What a sample of the generator is called in every file and on the page: "sample-000012".
std::string SampleName(std::int64_t index);

// The index in such a name; nullopt for any other text. Also in the names of runs of older
// versions: "sample-12" in elites.h5, "12" in scores.csv.
std::optional<std::int64_t> SampleIndex(const std::string& name);

}  // namespace antigrasp
