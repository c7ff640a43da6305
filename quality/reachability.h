#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>

#include "antigrasp/mesh/ray_scene.h"
#include "antigrasp/mesh/triangle_mesh.h"
#include "antigrasp/quality/contact.h"
#include "antigrasp/quality/gripper.h"

namespace antigrasp {

// Whether a gripper can come straight in to a grasp (paper III-B: U(x) is the set of reachable
// grasps). The opened gripper moves along its approach direction, over model.approach_distance, to
// the grasp; the boxes it sweeps must neither touch a triangle nor lie inside the solid (the first
// face seen from inside them is seen from behind). A box inside a cavity is free. Closing is not
// looked at: contacts stay two points, as in Dex-Net, though a wide finger may touch earlier.
//
// The answer moves with the object: angle 0 comes from the side away from the centre of mass, which
// is free most often; the others follow in the order 1, -1, 2, -2, ...
//
// The scene's blocks of faces and an exact box-triangle test. The same 870 box queries per object
// (20 intersected cylinders, 120 grasps each), build + queries in ms, before the blocks were there:
//   a tree of Eigen's (KdBVH) 0.6 + 0.8, CGAL's AABB tree with the boxes' faces 1.0 + 6.8, no tree
//   27, FCL 0.7's OBB tree 11 + 2.7, its OBBRSS tree 15 + 6.2
class GripperCollision {
 public:
  // The mesh and its scene must outlive this. Vertices finite, indices in range, metres.
  GripperCollision(const TriangleMesh& mesh, const RayScene& scene, const GripperModel& model);
  ~GripperCollision();
  GripperCollision(GripperCollision&&) noexcept;
  GripperCollision& operator=(GripperCollision&&) noexcept;

  // The first free one of model.approach_angles approach directions (unit, orthogonal to the grasp
  // axis) for a gripper opened to `opening`; nullopt when none is. Const and thread-safe.
  std::optional<Eigen::Vector3d> FreeApproach(const Grasp& grasp, double opening) const;

  // The same question for one direction.
  bool IsFree(const Grasp& grasp, double opening, const Eigen::Vector3d& approach) const;

 private:
  struct Impl;
  std::unique_ptr<const Impl> impl_;
};

}  // namespace antigrasp
