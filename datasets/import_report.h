#pragma once

#include <string>
#include <vector>

#include "antigrasp/datasets/import.h"

namespace antigrasp {

// One row a mesh (docs/formats.md).
std::string ImportCsv(const std::vector<ImportedMesh>& meshes);

// A line for each mesh that was repaired or refused, how many there are of each kind in `out`, and
// how many nodes of `resolution` their longest sides span.
std::string ImportText(const std::vector<ImportedMesh>& meshes, const std::string& out,
                       int resolution);

}  // namespace antigrasp
