#pragma once

// Plain numbers only: this header is compiled for several instruction sets, so nothing inline that
// the linker could share between them may be in it.
namespace antigrasp {

inline constexpr int kPyramidLanes = 8;

// The two-contact dual of wrench_dual.h in numbers, for friction pyramids of up to 8 edges (fewer
// are padded by repeating the last). Index 0 and 1 are the contacts; arrays of 3 are vectors.
struct PyramidInput {
  double cosine[kPyramidLanes], sine[kPyramidLanes];  // directions of the polar pyramid's edges
  double inset;                                       // friction * cos(pi / edges)
  double inward[2][3], t1[2][3], t2[2][3];            // unit normals and tangent frames
  double apex[2][3];                                  // inward / normal force
  double line[3], arm[3], kernel_force[3];
  double length, torque_scale, kernel2;
  double along[2];  // inward . line
  int base;
  double a, b, e;  // torsion bounds
};

// max |y|^2 over Q; -1 unless each contact lies well inside the other's friction pyramid. There C
// is the join of two polygons: its vertices are theirs, its edges are theirs and one from each
// vertex to each. One source, three instruction sets, the same bits (no contraction, no
// reassociation).
using PyramidKernel = double (*)(const PyramidInput&);
double MaxNorm2PyramidBaseline(const PyramidInput& input);  // SSE2
double MaxNorm2PyramidAvx2(const PyramidInput& input);
double MaxNorm2PyramidAvx512(const PyramidInput& input);

}  // namespace antigrasp
