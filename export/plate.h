#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "antigrasp/mesh/triangle_mesh.h"

namespace antigrasp {

// Solids for one print as 3MF, by lib3mf: millimetres, an object and an item of the build for each,
// in rows side by side 5 mm apart (an only one stays where it is). Their places are in the
// vertices: some readers take an item's own for another unit. Identifiers are made from the
// content, so that equal plates are equal bytes.
class Plate {
 public:
  void Add(const std::string& name, TriangleMesh mesh) {
    solids_.push_back({name, std::move(mesh)});
  }
  bool empty() const { return solids_.empty(); }
  // Writes `path`, named .3mf or not. RuntimeFailure when lib3mf refuses: no solid with two faces
  // at every edge, or a full disk.
  void Write(const std::filesystem::path& path) const;

 private:
  struct Solid {
    std::string name;
    TriangleMesh mesh;
  };
  std::vector<Eigen::Vector3d> Places() const;  // what is added to each

  std::vector<Solid> solids_;
};

}  // namespace antigrasp
