#include "antigrasp/core/error.h"
#include "antigrasp/mesh/mesh_readers.h"

namespace antigrasp {

PolygonSoup ReadDae(std::string_view /*bytes*/, const std::string& path) {
  throw InputError("built without COLLADA", path, "a build where libassimp-dev is installed");
}

}  // namespace antigrasp
