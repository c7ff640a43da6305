#pragma once

#include <optional>

#include "antigrasp/datasets/objects.h"
#include "antigrasp/mesh/mesh_file.h"

namespace antigrasp {

// A mesh as an object of a command: repaired, with its status and a note of what was done. `into`:
// the unit that it is turned into when its file knows its own. Without a name and a stream.
InputObject ObjectOf(MeshFile file, std::optional<LengthUnit> into);

}  // namespace antigrasp
