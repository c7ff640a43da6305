#pragma once

#include <string>
#include <string_view>

#include "antigrasp/mesh/polygon_soup.h"

// One reader per format, from the bytes of the whole file. They believe no count in the file: what
// is stored grows with what has been read, or is checked against the size first. InputError names
// `path`, and the line in text formats. Indices are checked later, by ToTriangleMesh().
//
// These are our own because CGAL's (5.5) drops NaN vertices of STL silently, skips corners after a
// tab in OBJ and refuses its line elements, and allocates what a PLY list length claims.
namespace antigrasp {

PolygonSoup ReadStl(std::string_view bytes, const std::string& path);
PolygonSoup ReadObj(std::string_view bytes, const std::string& path);
PolygonSoup ReadPly(std::string_view bytes, const std::string& path);
PolygonSoup ReadOff(std::string_view bytes, const std::string& path);

// These know their unit. lib3mf (1.8.1) does not end on components nested a few dozen deep and
// refuses a file for one face without area; glTF libraries hand indices and offsets on unchecked.
PolygonSoup Read3mf(std::string_view bytes, const std::string& path);
PolygonSoup ReadGlb(std::string_view bytes, const std::string& path);

// COLLADA, by assimp in a copy of the process, bounded in time and memory: a file that it dies of
// is an InputError.
PolygonSoup ReadDae(std::string_view bytes, const std::string& path);

}  // namespace antigrasp
