#pragma once

#include <cstdint>

// Plain numbers only: this header is compiled for several instruction sets, so nothing inline that
// the linker could share between them may be in it.
namespace antigrasp {

struct alignas(32) EightBoxes {
  float low[3][8], high[3][8];  // of no box: infinity, -infinity
};
struct alignas(32) BlockOfFaces {
  float corner[3][3][8];  // [corner][axis][face]; of no face: NaN
};
// Every side of a face as a line from its end b to its end a, in Pluecker coordinates: a - b and
// (a - b) x a = a x b, so that (a x b) . d - (a - b) . (o x d) says on which side of it the ray
// from o along d passes.
struct alignas(32) SidesOfFaces {
  float edge[3][3][8], moment[3][3][8];  // [side][axis][face]
  float longest;                         // edge of the block
};
struct BoxInFloat {
  float axis[3][3];  // [which][coordinate]
  float center[3], half[3];
};
struct UprightBox {
  float low[3], high[3];
};
struct RayInFloat {
  float origin[3], direction[3];
  float length;  // of the segment that can matter
};
struct CastRays {
  const RayInFloat* rays;
  const UprightBox* segments;  // of each what can matter, in a frame of theirs
  int count;
};
// Blocks near some rays: their numbers, eight to a group, and their boxes in that frame; of no
// block: any number, no box.
struct NearBlocks {
  const EightBoxes* boxes;
  const std::uint32_t* numbers;
  int groups;
};
// Of a mesh: its faces, their sides (null: none are kept) and how far from the origin they reach.
struct CastBlocks {
  const BlockOfFaces* faces;
  const SidesOfFaces* sides;
  float radius;
};
// Of ray i the slots 8 block + lane from capacity i on, at most `capacity` of the counts[i] met.
struct MetFaces {
  int* counts;
  std::uint32_t* slots;
  int capacity;
};

// One source, two instruction sets. Masks have bit i for item i.
struct FaceKernels {
  // Boxes that may meet an oriented one; bounds of faces in its frame that overlap it.
  unsigned (*boxes_near)(const EightBoxes& boxes, const BoxInFloat& box);
  unsigned (*boxes_met)(const RayInFloat& ray, const EightBoxes& boxes);  // null as faces_met
  unsigned (*faces_in)(const BlockOfFaces& block, const BoxInFloat& box);
  // Boxes that meet one with its sides along the axes; touching counts.
  unsigned (*boxes_touching)(const EightBoxes& boxes, const UprightBox& box);
  // For every face of `block` the faces of `other` whose boxes meet its own.
  void (*faces_touching)(const BlockOfFaces& block, const BlockOfFaces& other,
                         unsigned char* masks);
  // Puts boxes along the axes of a frame with the same origin around them.
  void (*turn_boxes)(const float (&axes)[3][3], EightBoxes* boxes);
  // The faces that each ray's line meets, at any distance, within the near blocks that its segment
  // may meet. By the operations of Embree's robust test in its order, with fused multiply-adds, so
  // that it meets the faces that Embree's rays meet on processors with AVX2; where the sides leave
  // no doubt about what that finds, by them. Null without them, as take_sides.
  void (*faces_met)(const CastRays& rays, const NearBlocks& near, const CastBlocks& blocks,
                    const MetFaces& met);
  void (*take_sides)(const BlockOfFaces& block, SidesOfFaces* sides);
};
FaceKernels FaceKernelsBaseline();
FaceKernels FaceKernelsAvx2();

}  // namespace antigrasp
