#pragma once

#include <array>
#include <cstdint>

#include "antigrasp/core/choice.h"
#include "antigrasp/core/options.h"
#include "antigrasp/core/parallel.h"
#include "antigrasp/mesh/triangle_mesh.h"

// The adversarial polyhedra of the paper's experiments (VII-A): solids of which no two faces oppose
// each other well enough to be pinched.
namespace antigrasp {

// The antipodality angle of two faces is phi(f_i, f_j) = arccos(-n_i . n_j), n the outward unit
// normals (section IV): 0 for parallel faces that look away from each other. A grasp on two faces
// needs a line that is within the friction cone's half angle psi of both normals, so that
// phi > 2 psi rules it out.
struct Antipodality {
  double degrees = 180.0;
  std::size_t first = 0, second = 0;  // the two faces
};

// The smallest one over ALL pairs of faces of a mesh, whether or not a line joins them inside both
// cones: this is VII-A's "any pair of faces". Computed from the normals in double by atan2, good to
// 1e-13 degrees. Faces without area are left out. 10 ms for 2,500 faces. No closed surface has more
// than kBestAntipodality: its normals lie in no hemisphere, so two of them are at least
// arccos(-1/3) apart (Jung's theorem on the sphere). The regular tetrahedron has it.
Antipodality SmallestAntipodality(const TriangleMesh& mesh);
inline constexpr double kBestAntipodality = 70.52877936550931;

// Whether no vertex lies in front of a face by more than 1e-6 of the mesh's size.
bool IsConvex(const TriangleMesh& mesh);

enum class Polyhedron {
  kCube,
  kTetrahedron,
  kOctahedron,
  kCuboctahedron,
  kDodecahedron,
  kIcosahedron
};
constexpr auto ChoicesOf(Polyhedron) {
  return std::to_array<Choice<Polyhedron>>({{Polyhedron::kCube, "cube"},
                                            {Polyhedron::kTetrahedron, "tetrahedron"},
                                            {Polyhedron::kOctahedron, "octahedron"},
                                            {Polyhedron::kCuboctahedron, "cuboctahedron"},
                                            {Polyhedron::kDodecahedron, "dodecahedron"},
                                            {Polyhedron::kIcosahedron, "icosahedron"}});
}

// Centred over the origin, inscribed in a cube of this edge (which the cube fills).
TriangleMesh PlainPolyhedron(Polyhedron kind, double size);

struct PolyhedronOptions {
  double phi = 0.0;    // degrees: no two faces may be more antipodal
  double size = 40.0;  // of PlainPolyhedron
  std::uint64_t seed = 1;
  int restarts = 4;  // searches; the one that moves the corners least wins
  int moves = 100;   // tried per corner in each of the ten rounds of a search
};
void Bind(OptionTable* table, PolyhedronOptions* options);  // keys "shape.*": restarts, moves

struct AdversarialPolyhedron {
  TriangleMesh mesh;  // in single precision, as an STL file holds it; all below is of this mesh
  Antipodality antipodality;
  bool reached = false;       // antipodality >= phi up to 1e-4 degrees
  double largest_move = 0.0;  // of a corner, as a share of the size
  double rms_move = 0.0;      // the same, root mean square over the corners
};

// A convex solid with antipodality of at least options.phi, near to the plain one. One that has it
// anyway comes back as it is; where phi is out of reach, the best that was found.
//   cube: a pyramid of height tan(phi) / 2 edges on three adjacent faces (the paper's formula), so
//     that each opposes a flat face under phi. Pyramids on neighbouring faces oppose each other
//     under 90 - 2 phi: 30 degrees is the best this reaches.
//   the others: random moves of single corners ("random perturbations", VII-A); the solid is the
//     convex hull of the corners, and a move that takes a corner off the hull is refused, so that
//     there are no concavities. A move is kept when it lowers
//       sum of squared corner displacements + w * sum over pairs of max(0, phi - phi_ij)^2
//     in ten rounds of growing w; the last two keep to phi and only shrink the displacement.
// Same result for any number of threads. 1 ms for the cube, 1-2 s per search otherwise.
AdversarialPolyhedron MakeAdversarialPolyhedron(Polyhedron kind, const PolyhedronOptions& options,
                                                int threads = 0,
                                                const ProgressFn& progress = nullptr);

}  // namespace antigrasp
