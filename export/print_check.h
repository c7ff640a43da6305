#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "antigrasp/core/options.h"
#include "antigrasp/mesh/triangle_mesh.h"

namespace antigrasp {

// What the printer can do. Defaults: filament printing (FDM) with a 0.4 mm nozzle, for which
// Redwood et al., "The 3D Printing Handbook" (3D Hubs, 2017) gives walls of 0.8 mm (two lines) and
// 45 degrees; its number for sintered nylon (SLS), the paper's material, is 0.7 mm and no support.
struct PrintOptions {
  double min_wall_mm = 0.8;       // thinner walls are named in the notes
  double overhang_angle = 45.0;   // steepest underside printed without support, from vertical, deg
  double max_overhang = 0.05;     // share of the surface; more is named in the notes
  double layer_mm = 0.2;          // what lies within the first layer rests on the plate
  double opposite_angle = 45.0;   // how far two sides of a wall may be from parallel, degrees
  double min_probability = 0.01;  // likelier stable poses are considered for printing
  // Area on the plate below which the notes ask for a raft; ours: a disc of 3.6 mm.
  double min_contact_mm2 = 10.0;
};

void Bind(OptionTable* table, PrintOptions* options);  // keys "print.*"

// An object at its printed size.
struct PrintCheck {
  double mm_per_unit = 0.0;                                 // millimetres per unit of the mesh
  Eigen::Vector3d size_mm = Eigen::Vector3d::Zero();        // extents in the mesh's own frame
  Eigen::Vector3d print_size_mm = Eigen::Vector3d::Zero();  // and in the suggested pose
  bool watertight = false;                                  // closed and wound outward
  std::string why_not_solid;      // "" when it is a printable solid (Inspect)
  int voids = 0;                  // closed in, inside the body
  std::optional<double> wall_mm;  // smallest wall (wall_thickness.h); none when nothing is one
  Eigen::Vector3d wall_at = Eigen::Vector3d::Zero();  // where, on the mesh
  bool thin = false;                                  // that wall is below min_wall_mm
  double thin_share = 0.0;                            // of the surface, in walls below min_wall_mm
  // The stable pose suggested for printing, as StablePose: rows are the plate's axes in the mesh's
  // frame, row 2 points up. Identity with probability 0 when there is no stable pose.
  Eigen::Matrix3d table_from_object = Eigen::Matrix3d::Identity();
  double pose_probability = 0.0;  // of the pose after a drop in a random orientation
  double overhang_share = 0.0;    // of the surface, in that pose (overhang.h)
  double contact_mm2 = 0.0;       // area on the plate in that pose
  // By how much each coordinate may be off: a mesh of single-precision numbers far from the origin.
  // What is at a limit within that passes.
  double rounding_mm = 0.0;
  std::vector<std::string> notes;  // what to look at before printing, a sentence each; may be empty
};

// Checks the object as it is printed with its largest extent in its own frame at `size_mm`. Of the
// stable poses with at least min_probability (always the likeliest) the one with the least overhang
// is suggested; among poses within 0.5 % of the surface of it the one with the largest area on the
// plate, then the one with the lowest centre of mass, then the likeliest; of equally likely ones
// that whose upward axis comes first in the order of x, y, z. The same for a solid wherever it
// lies; a wall, a slope, a first layer or an area on the plate of exactly the limit passes
// (rounding.h).
//
// Any finite mesh with a positive extent (CHECKed), also one that is no solid: the notes say so.
// Deterministic. 15-40 ms for 2,500 faces, nearly all of it Inspect and StablePoses.
PrintCheck CheckPrint(const TriangleMesh& mesh, double size_mm, const PrintOptions& options = {});

// The mesh in millimetres, turned by `table_from_object`, centred over the origin and standing on
// z = 0.
TriangleMesh PlacedForPrint(const TriangleMesh& mesh, const PrintCheck& check,
                            const Eigen::Matrix3d& table_from_object);

}  // namespace antigrasp
