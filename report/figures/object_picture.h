#pragma once

#include <vector>

#include "antigrasp/mesh/ray_scene.h"
#include "antigrasp/render/render_mesh.h"
#include "antigrasp/report/figures/canvas.h"

namespace antigrasp {

// What the figures share.
struct FigureOptions {
  double width_mm = 180.0;  // of the page; a journal's two columns
  double dpi = 300.0;       // of the rendered objects, and of a PNG
  int columns = 0;          // objects beside each other; 0 = as many as suit the figure
  int threads = 0;          // 0 = all; the picture does not depend on it
  View view;                // camera and shading; its pixels are set by the figure

  double Width() const { return width_mm * 72.0 / 25.4; }  // points
  // Side of a rendered picture of this many points, in pixels.
  int Pixels(double points) const;
};

// A piece of a line in space, seen by the camera: all in front of the mesh or all behind it.
struct SeenPiece {
  Place from, to;  // in the picture: (0, 0) its top left corner, (1, 1) the bottom right
  bool visible = true;
};

// The line from a to b cut where it goes behind the mesh of the scene or comes out. `size`: of the
// mesh, how far the camera is away at least. 0.1 ms.
std::vector<SeenPiece> SeenLine(const RayScene& scene, const Camera& camera, double size,
                                const Eigen::Vector3d& a, const Eigen::Vector3d& b);

// The camera of the view with what is seen of the mesh in the middle of its picture, which is
// `margin` times as wide as that needs.
Camera FigureCamera(const TriangleMesh& mesh, const View& view, double margin = 1.04);

// The place of a picture's point on the page.
inline Place OnPage(const Area& picture, const Place& p) {
  return {picture.x + p.x * picture.width, picture.y + p.y * picture.height};
}

}  // namespace antigrasp
