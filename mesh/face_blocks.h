#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "antigrasp/mesh/face_kernels.h"

namespace antigrasp {

// A box with its axes as columns.
struct OrientedBox {
  Eigen::Matrix3d axes;
  Eigen::Vector3d center;
  Eigen::Vector3d half;  // along the axes
};

// A ray about the centre of the blocks, up to where it can meet one.
struct LocalRay {
  Eigen::Vector3d origin;
  Eigen::Vector3d direction;  // unit
  double length;
};

// Blocks of faces in groups of eight, the last one filled up with the first block, and their boxes,
// which lie along the columns of `axes`, the first of which runs about as the rays do; of no block,
// no box.
struct NearFaces {
  std::vector<std::uint32_t> blocks;
  std::vector<EightBoxes> boxes;
  Eigen::Matrix3d axes;
};

// All faces of a mesh in blocks of eight that lie near each other, and a tree of their boxes: to
// find what is near a box or a few rays. In float about the mesh's centre; what it leaves out is
// certainly not there, what it returns may not be either. 0.2 ms for 3,000 faces (Embree's tree
// 0.6, which is the better one for many rays).
class FaceBlocks {
 public:
  // `vertices` about `center`, finite; corners in range.
  FaceBlocks(const std::vector<Eigen::Vector3f>& vertices,
             const std::vector<std::array<std::int32_t, 3>>& corners,
             const Eigen::Vector3d& center);

  // Appends the blocks whose boxes may meet `box`.
  void Near(const OrientedBox& box, std::vector<std::uint32_t>* blocks) const;
  // The first of those faces for which `meets` holds, of those whose bounds in the box's frame
  // overlap it; -1 without one.
  template <typename Meets>
  std::int64_t FindIn(const OrientedBox& box, const std::vector<std::uint32_t>& blocks,
                      const Meets& meets) const {
    const BoxInFloat in_float = OfBox(box);
    for (const std::uint32_t block : blocks) {
      unsigned lanes = FacesIn(block, in_float);
      for (; lanes != 0; lanes &= lanes - 1) {
        const auto lane = static_cast<std::uint32_t>(__builtin_ctz(lanes));
        const std::uint32_t face = FaceOf(8 * block + lane);
        if (meets(face)) return face;
      }
    }
    return -1;
  }

  // Calls visit(face, face) once for every two faces whose boxes along the axes meet, touching
  // included, until it returns true; whether it did. Boxes of the vertices in float.
  template <typename Visit>
  bool AnyTouching(const Visit& visit) const {
    std::vector<std::uint32_t> near;
    for (std::uint32_t block = 0; block < blocks_.size(); ++block) {
      near.clear();
      NearFrom(block, &near);
      for (const std::uint32_t other : near) {
        const std::array<unsigned char, 8> masks = FacesTouching(block, other);
        for (std::uint32_t lane = 0; lane < 8; ++lane) {
          unsigned lanes = masks[lane];
          if (block == other) lanes &= (1u << lane) - 1;
          for (; lanes != 0; lanes &= lanes - 1) {
            const auto bit = static_cast<std::uint32_t>(__builtin_ctz(lanes));
            if (visit(FaceOf(8 * block + lane), FaceOf(8 * other + bit))) return true;
          }
        }
      }
    }
    return false;
  }

  // Blocks with their boxes, for Met: near a box, near a ray's segment.
  void NearBox(const OrientedBox& box, NearFaces* near) const;
  void NearLine(const LocalRay& ray, NearFaces* near) const;

  // Whether Met can be asked: the processor has fused multiply-adds, and the sizes are far from
  // float's ends.
  bool CanCast() const;
  // Slots of the faces that each ray's line meets, of the near blocks that its segment may meet.
  // Rays and `met` are as many, at most kTogether.
  static constexpr int kTogether = 32, kMostMet = 32;
  struct Slots {
    int counts[kTogether];  // may be more than kMostMet: not all are there
    std::uint32_t slots[kTogether][kMostMet];
  };
  void Met(std::span<const LocalRay> rays, const NearFaces& near, Slots* met) const;

  const Eigen::Vector3d& center() const { return center_; }
  double radius() const { return radius_; }  // of a ball about the centre that holds all vertices
  // Of slot 8 block + lane; kNoFace behind the last one.
  std::uint32_t FaceOf(std::uint32_t slot) const { return face_[slot]; }
  static constexpr std::uint32_t kNoFace = ~0u;

 private:
  BoxInFloat OfBox(const OrientedBox& box) const;
  unsigned FacesIn(std::uint32_t block, const BoxInFloat& box) const;
  // Appends the blocks from `block` on whose boxes meet its own.
  void NearFrom(std::uint32_t block, std::vector<std::uint32_t>* blocks) const;
  std::array<unsigned char, 8> FacesTouching(std::uint32_t block, std::uint32_t other) const;
  template <typename NearEight>
  void Collect(const NearEight& near, std::vector<std::uint32_t>* blocks,
               std::size_t from = 0) const;
  void TakeBoxes(const Eigen::Matrix3d& axes, NearFaces* near) const;
  void AddLevels();

  Eigen::Vector3d center_;
  double radius_ = 0.0;
  std::vector<std::uint32_t> face_;
  std::vector<BlockOfFaces> blocks_;
  std::vector<SidesOfFaces> sides_;              // none of big meshes
  std::vector<std::vector<EightBoxes>> levels_;  // of blocks, of eight boxes, ... of all
};

}  // namespace antigrasp
