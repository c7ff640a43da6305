#pragma once

#include <map>
#include <string>

namespace antigrasp::shapes {

// The core namespace of 3MF, and a model of a cube of edge 20 from the origin, as object 1.
inline constexpr const char* k3mfCore = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02";
std::string CubeXml(const std::string& more_triangles = "");
std::string ModelXml(const std::string& unit, const std::string& resources,
                     const std::string& build);

// A zip archive of files by name, packed by libzip; and one that is a 3MF package with this model.
std::string ZipBytes(const std::map<std::string, std::string>& files);
std::string ThreeMfBytes(const std::string& model,
                         const std::map<std::string, std::string>& more = {});

// GLB of JSON text and a binary chunk.
std::string GlbBytes(std::string json, std::string bin);
// A cube of edge 0.02 from the origin in mesh 0, indices of 16 bits, one node of it with `node`.
std::string CubeGlb(const std::string& node = "");
// The text and the bytes of that cube, to be changed.
std::string CubeJson(const std::string& node = "");
std::string CubeBin();

}  // namespace antigrasp::shapes
