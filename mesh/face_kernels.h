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
// Blocks near some rays: their numbers, eight to a group, and their boxes.
struct NearBlocks {
  const EightBoxes* boxes;
  const std::uint32_t* numbers;
  int groups;
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
  // Slots 8 block + lane of the faces that the ray's line meets, at any distance, within the near
  // blocks that its segment may meet: how many, or -1 where they are more than `capacity`. By the
  // operations of Embree's robust test in its order, with fused multiply-adds, so that it meets the
  // faces that Embree's rays meet on processors with AVX2. Null without them.
  int (*faces_met)(const RayInFloat& ray, const NearBlocks& near, const BlockOfFaces* blocks,
                   std::uint32_t* slots, int capacity);
};
FaceKernels FaceKernelsBaseline();
FaceKernels FaceKernelsAvx2();

}  // namespace antigrasp
