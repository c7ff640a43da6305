#pragma once

#include <Eigen/Core>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "antigrasp/mesh/triangle_mesh.h"

namespace antigrasp {

// "\"mug\"": a string of USD's text format, quoted and escaped.
std::string UsdString(std::string_view text);
std::string UsdTuple(std::initializer_list<double> values);  // "(0.5, 0, -1)"
std::string UsdTuple(const Eigen::Vector3d& v);

// A stage in USD's text format line by line, prims indented: metres, kilograms, z up.
class UsdWriter {
 public:
  UsdWriter(std::string_view default_prim, std::string_view comment);
  // def TYPE "NAME" (prepend apiSchemas = [...]), and more lines of metadata.
  void Open(std::string_view type, std::string_view name,
            const std::vector<std::string>& schemas = {},
            const std::vector<std::string>& metadata = {});
  void Line(std::string_view text);  // "float physics:mass = 0.5"
  void Close();
  // The lines of a Mesh: triangles as they are, flat.
  void Triangles(const TriangleMesh& mesh);
  std::string Take();  // every prim closed

 private:
  std::string text_;
  std::size_t open_ = 0;
};

}  // namespace antigrasp
