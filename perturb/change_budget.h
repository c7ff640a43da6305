#pragma once

#include <Eigen/Core>
#include <string>
#include <utility>
#include <vector>

#include "antigrasp/core/options.h"
#include "antigrasp/mesh/triangle_mesh.h"

namespace antigrasp {

// How far an object may be changed; a user names it. What is written never exceeds one.
struct ChangeBudget {
  double hausdorff = 5.0;   // distance of the surfaces, percent of the bounding box's diagonal
  double volume = 20.0;     // change of volume, percent, either way
  double turn = 60.0;       // of a face's normal, degrees
  double roughness = 25.0;  // rise of MeanDihedralAngle, percent of what the original has
};
void Bind(OptionTable* table, ChangeBudget* budget);  // keys "search.*"

// A change of one solid under its budget.
class BudgetKeeper {
 public:
  // `start` must outlive this; a solid.
  BudgetKeeper(const TriangleMesh& start, const ChangeBudget& budget);

  // A change in which no vertex moves farther keeps the Hausdorff distance: points of a face lie
  // between its corners. The mesh's unit, a little inside.
  double longest_move() const { return longest_move_; }

  // Which limit the mesh (the same faces) breaks, "" when it keeps all and is a printable solid:
  // "moved too far", "volume", "turned", "roughness", or as WhyNotPrintable.
  std::string Broken(const TriangleMesh& mesh) const;

  // Adds the derivative of a penalty that is 0 well inside the budget: by the unit normals of the
  // faces and by the vertices (of the mesh in its own unit). `normals` are the mesh's.
  void AddPenalty(const TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& normals,
                  std::vector<Eigen::Vector3d>* by_normal,
                  std::vector<Eigen::Vector3d>* by_vertex) const;

 private:
  void AddTurn(const std::vector<Eigen::Vector3d>& normals,
               std::vector<Eigen::Vector3d>* by_normal) const;
  void AddRoughness(const TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& normals,
                    std::vector<Eigen::Vector3d>* by_normal) const;
  void AddVolume(const TriangleMesh& mesh, std::vector<Eigen::Vector3d>* by_vertex) const;

  struct Edge {
    std::size_t low, high;  // vertices
    std::pair<std::size_t, std::size_t> faces;
  };

  const TriangleMesh& start_;
  ChangeBudget budget_;
  std::vector<Eigen::Vector3d> start_normals_;
  std::vector<Edge> edges_;
  double longest_move_, volume_, roughness_;
};

}  // namespace antigrasp
