#include "antigrasp/core/error.h"
#include "antigrasp/mesh/mesh_readers.h"

namespace antigrasp {

PolygonSoup Read3mf(std::string_view /*bytes*/, const std::string& path) {
  throw InputError("built without 3MF", path,
                   "a build where libzip-dev and libexpat1-dev are installed");
}

}  // namespace antigrasp
