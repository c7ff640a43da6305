#pragma once

#include <Eigen/Core>
#include <array>

#include "antigrasp/core/options.h"
#include "antigrasp/mesh/triangle_mesh.h"

namespace antigrasp {

// A parallel-jaw gripper: two fingers and a palm, all boxes. Metres.
//
// Gripper frame (Dex-Net's grasp frame): the origin is the grasp centre, x the approach direction
// (out of the palm, towards the fingertips), y the grasp axis (from jaw 1 to jaw 2), z = x cross y.
// The approach angle turns the frame about y. At an opening w
//   fingers  x in [-palm_distance, fingertip_overlap], |y| in [w / 2, w / 2 + finger_thickness],
//            |z| <= finger_width / 2
//   palm     x in [-palm_distance - palm_depth, -palm_distance], |y| <= palm_length / 2,
//            |z| <= palm_width / 2
//
// Defaults: the ABB YuMi servo gripper with Dex-Net's fingers, as far as numbers are published.
// Others: named_gripper.h.
//   fingertip_overlap, finger_width / 2: the pad is a disc of finger_radius 0.010 about the contact
//     (Dex-Net, data/grippers/yumi_metal_spline/params.json)
//   palm_depth: the fingers' joint is 83.7 mm from the flange (OrebroUniversity/yumi,
//     yumi_servo_gripper.xacro); palm_distance: the jaw centre is 130 mm from it (wanweiwei07/wrs,
//     YumiGripper.jaw_center_pos), 46 mm further
//   approach_distance: Dex-Net, cfg/tools/generate_gqcnn_dataset.yaml, approach_dist
//   finger_thickness, palm_length, palm_width, approach_angles: ours
struct GripperModel {
  double palm_distance = 0.046;      // from the palm's face to the grasp centre
  double fingertip_overlap = 0.010;  // how far the fingertips reach beyond the grasp centre
  double finger_width = 0.020;       // across grasp axis and approach
  double finger_thickness = 0.010;   // along the grasp axis
  double palm_depth = 0.084;         // along the approach
  double palm_length = 0.080;        // along the grasp axis
  double palm_width = 0.050;         // across both
  double approach_distance = 0.100;  // length of the straight way in
  int approach_angles = 16;          // tried per grasp, equally spaced about the grasp axis
};

void Bind(OptionTable* table, GripperModel* model);  // keys "gripper.*"

// Finger 1, finger 2 (at +y) and palm in the gripper frame, swept backwards over `retreat` metres:
// they move along their own edges, so that what they sweep is a box again. 0 = as they stand at the
// grasp.
std::array<BoundingBox, 3> GripperBoxes(const GripperModel& model, double opening, double retreat);

// The three boxes at an opening as one mesh, each closed on its own: to look at.
TriangleMesh GripperMesh(const GripperModel& model, double opening);

}  // namespace antigrasp
