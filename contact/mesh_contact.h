#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <vector>

#include "antigrasp/contact/tip_pose.h"
#include "antigrasp/mesh/triangle_mesh.h"

namespace antigrasp {

inline constexpr int kMostContacts = 8;  // of one tip or table, where nothing else is said

// The faces near a tip, kept from call to call while the tip stays within `slack` (metres) of where
// it was: answers have the same bits with and without. Start with an empty one for every tip and
// solid; not shared between threads.
struct TouchCache {
  double slack = 0.5e-3;

  std::vector<std::int32_t> faces;
  double reach = -1.0;  // below 0: holds nothing
  PadPose region;       // a sphere's: its centre alone
};

// Fingertips against a solid made of triangles, dents and all. Object frame, metres. Exact but for
// rounding in double; nothing is replaced by its hull. Const and thread-safe.
class ContactSolid {
 public:
  // Closed and outward. 10 ms for 2,500 faces.
  explicit ContactSolid(const TriangleMesh& mesh);
  ~ContactSolid();
  ContactSolid(ContactSolid&&) noexcept;
  ContactSolid& operator=(ContactSolid&&) noexcept;

  // Where a sphere touches: every local minimum of the distance from its centre to the surface that
  // is within radius + margin, nearest first; of those whose normals are less than 8 degrees apart
  // the nearest alone. Minima that are seen through the material (a thin wall's far side) are none.
  // With the centre inside the solid (deeper than the radius) the same from within; normals point
  // out. Writes at most `most` to `out` and returns how many. About a microsecond.
  int Touch(const SpherePose& sphere, double margin, SurfaceContact* out, int most = 4,
            TouchCache* cache = nullptr) const;

  // Where the front face of a pad touches, as corners of the patch: the surface in front of the
  // rectangle, from the margin ahead to the pad's back, cut out exactly, then PatchCorners. A flat
  // face gives the corners of the polygon that it has in common with the pad however it is cut into
  // triangles; where the surface bends away the patch ends at the margin. Approximate: of a curved
  // or bumpy patch a few points stand for all; the sides of the pad touch nothing; where a ridge
  // crosses the rim the normal is that of one of its two faces. `exact_load`, for simulations whose
  // steps are so small that what overlaps is a load and not a step: a ridge that leans touches at
  // both of its ends where both overlap, and what has come in through a side of the pad is touched
  // by that side.
  int Touch(const PadPose& pad, double margin, SurfaceContact* out, int most = kMostContacts,
            TouchCache* cache = nullptr, bool exact_load = false) const;

  // Where a table {x: normal . x <= offset} touches (normal: unit): corners of the object's hull,
  // chosen as a pad's, so that the support polygon is kept. Here alone the contact's normal is the
  // table's, up and into the object.
  int TouchPlane(const Eigen::Vector3d& normal, double offset, double margin, SurfaceContact* out,
                 int most = 6) const;

  // Gap between the tip and the solid, infinity beyond `limit`. A sphere's is exact and below 0
  // (the depth) where they overlap. A pad's is never more than the gap, equal to it where what is
  // nearest is a face, of the box or of the mesh, or two edges that cross, and 0 where they
  // overlap: steps of this length never pass through.
  double Distance(const SpherePose& sphere, double limit) const;
  double Distance(const PadPose& pad, double limit) const;

  // Whether tip and solid have a point in common.
  bool Overlaps(const SpherePose& sphere) const;
  bool Overlaps(const PadPose& pad) const;

 private:
  struct Impl;
  std::unique_ptr<const Impl> impl_;
};

}  // namespace antigrasp
