#pragma once

#include "antigrasp/mesh/triangle_mesh.h"
#include "antigrasp/render/camera.h"
#include "antigrasp/render/image.h"

namespace antigrasp {

// Where from and how large. z is up; the camera looks at the middle of the bounding box.
struct View {
  double azimuth = -60.0;   // of the camera about z, degrees from the x axis
  double elevation = 25.0;  // above the xy plane, degrees
  int pixels = 256;         // side of the square picture
  int samples = 2;          // rays per pixel and side
  double crease = 30.0;     // faces that meet at less than this angle are shaded as one, degrees
  Rgb color = {118, 148, 196};
};

// A parallel projection of the mesh on white. The ball around the middle of its bounding box that
// holds it fills the picture: the same size from everywhere. Cast with Embree, shaded by a light
// that moves with the camera. No display or GPU; the same pixels on any machine and for any number
// of threads. An empty mesh is white. Finite vertices. 30 ms for 256 pixels and 3,000 faces, single
// thread.
Image RenderMesh(const TriangleMesh& mesh, const View& view = {});

// The same from a camera of one's own (the view's azimuth and elevation are not used), to be laid
// over something else: opaque where the mesh is, clear around it, with smooth borders.
RgbaImage RenderOnNothing(const TriangleMesh& mesh, const Camera& camera, const View& view = {});

}  // namespace antigrasp
