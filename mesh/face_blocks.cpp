#include "antigrasp/mesh/face_blocks.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <bit>
#include <limits>

namespace antigrasp {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;
using Corners = std::vector<std::array<std::int32_t, 3>>;

const FaceKernels& FaceKernelsHere() {
  static const FaceKernels kernels = [] {
#ifdef __x86_64__
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return FaceKernelsAvx2();
#endif
    return FaceKernelsBaseline();
  }();
  return kernels;
}

// What rounding to float, and float arithmetic, can move a point by, relative to its size.
constexpr double kFloatSlack = 2e-6;

constexpr float kFarOff = std::numeric_limits<float>::infinity();
constexpr EightBoxes kNoBoxes = [] {
  EightBoxes boxes{};
  for (int k = 0; k < 3; ++k) {
    for (int lane = 0; lane < 8; ++lane) {
      boxes.low[k][lane] = kFarOff;
      boxes.high[k][lane] = -kFarOff;
    }
  }
  return boxes;
}();

struct Middle {
  Vector3f at;
  std::uint32_t face;
};

// Cuts across the longest side of [low, high] until eight are left, so that faces of a block lie
// near each other. To the left go 8 times a power of two: blocks in groups of eight, and groups in
// groups, are then what one cut left together.
void Sort(std::span<Middle> faces, Vector3f low, Vector3f high) {
  while (faces.size() > 8) {
    const std::size_t left = 8 * std::bit_floor((faces.size() + 7) / 8 - 1);
    Eigen::Index axis;
    (high - low).maxCoeff(&axis);
    const auto cut = faces.begin() + static_cast<std::ptrdiff_t>(left);
    std::nth_element(faces.begin(), cut, faces.end(),
                     [axis](const Middle& x, const Middle& y) { return x.at[axis] < y.at[axis]; });
    Vector3f middle = high;
    middle[axis] = cut->at[axis];
    Sort(faces.first(left), low, middle);
    low[axis] = cut->at[axis];
    faces = faces.subspan(left);
  }
}

std::vector<Middle> NearEachOther(const std::vector<Vector3f>& vertices, const Corners& corners,
                                  const Eigen::AlignedBox3f& box) {
  std::vector<Middle> faces(corners.size());
  for (std::size_t i = 0; i < faces.size(); ++i) {
    Vector3f sum = Vector3f::Zero();
    for (const std::int32_t v : corners[i]) sum += vertices[static_cast<std::size_t>(v)];
    faces[i] = {sum / 3.0f, static_cast<std::uint32_t>(i)};
  }
  Sort(faces, box.min(), box.max());
  return faces;
}

RayInFloat InFloat(const Vector3d& origin, const Vector3d& direction, double length) {
  RayInFloat ray;
  for (int k = 0; k < 3; ++k) {
    ray.origin[k] = static_cast<float>(origin[k]);
    ray.direction[k] = static_cast<float>(direction[k]);
  }
  ray.length = static_cast<float>(length);
  return ray;
}

EightBoxes BoxesOf(const std::vector<EightBoxes>& children, std::size_t first) {
  EightBoxes boxes = kNoBoxes;
  for (std::size_t i = 0; i < 8 && first + i < children.size(); ++i) {
    const EightBoxes& child = children[first + i];
    for (int k = 0; k < 3; ++k) {
      boxes.low[k][i] = *std::min_element(child.low[k], child.low[k] + 8);
      boxes.high[k][i] = *std::max_element(child.high[k], child.high[k] + 8);
    }
  }
  return boxes;
}

}  // namespace

FaceBlocks::FaceBlocks(const std::vector<Vector3f>& vertices, const Corners& corners,
                       const Vector3d& center)
    : center_(center), blocks_((corners.size() + 7) / 8) {
  Eigen::AlignedBox3f bounds;
  for (const Vector3f& vertex : vertices) bounds.extend(vertex);
  if (!vertices.empty()) {
    radius_ = bounds.min().cwiseAbs().cwiseMax(bounds.max().cwiseAbs()).cast<double>().norm();
  }
  const std::vector<Middle> order = NearEachOther(vertices, corners, bounds);
  face_.assign(8 * blocks_.size(), kNoFace);
  std::vector<EightBoxes> boxes((blocks_.size() + 7) / 8, kNoBoxes);
  if (!blocks_.empty()) {
    std::fill_n(&blocks_.back().corner[0][0][0], sizeof(BlockOfFaces) / sizeof(float),
                std::numeric_limits<float>::quiet_NaN());
  }
  for (std::size_t slot = 0; slot < order.size(); ++slot) {
    const std::size_t block = slot / 8, lane = slot % 8;
    face_[slot] = order[slot].face;
    Eigen::AlignedBox3f box;
    for (std::size_t c = 0; c < 3; ++c) {
      const Vector3f& at = vertices[static_cast<std::size_t>(corners[order[slot].face][c])];
      box.extend(at);
      for (int k = 0; k < 3; ++k) blocks_[block].corner[c][k][lane] = at[k];
    }
    EightBoxes& boxes_of = boxes[block / 8];
    for (int k = 0; k < 3; ++k) {
      boxes_of.low[k][block % 8] = std::min(boxes_of.low[k][block % 8], box.min()[k]);
      boxes_of.high[k][block % 8] = std::max(boxes_of.high[k][block % 8], box.max()[k]);
    }
  }
  levels_.push_back(std::move(boxes));
  AddLevels();
}

void FaceBlocks::AddLevels() {
  while (levels_.back().size() > 1) {
    const std::vector<EightBoxes>& below = levels_.back();
    std::vector<EightBoxes> level;
    for (std::size_t first = 0; first < below.size(); first += 8) {
      level.push_back(BoxesOf(below, first));
    }
    levels_.push_back(std::move(level));
  }
}

BoxInFloat FaceBlocks::OfBox(const OrientedBox& box) const {
  const Vector3d center = box.center - center_;
  const double slack = kFloatSlack * (radius_ + center.norm() + box.half.sum());
  BoxInFloat out;
  for (int a = 0; a < 3; ++a) {
    out.center[a] = static_cast<float>(center[a]);
    out.half[a] = static_cast<float>(box.half[a] + slack);
    for (int k = 0; k < 3; ++k) out.axis[a][k] = static_cast<float>(box.axes(k, a));
  }
  return out;
}

template <typename NearEight>
void FaceBlocks::Collect(const NearEight& near, std::vector<std::uint32_t>* blocks,
                         std::size_t from) const {
  if (blocks_.empty()) return;
  struct Node {
    std::size_t level, number;
  };
  std::array<Node, 8 * 12> open;  // seven more a level; 8^11 blocks are more than 2^32
  std::size_t count = 0;
  open[count++] = {levels_.size() - 1, 0};
  while (count > 0) {
    const Node node = open[--count];
    unsigned lanes = near(levels_[node.level][node.number]);
    for (; lanes != 0; lanes &= lanes - 1) {
      const std::size_t child = 8 * node.number + static_cast<std::size_t>(__builtin_ctz(lanes));
      if (child < from >> (3 * node.level)) continue;
      if (node.level == 0) {
        blocks->push_back(static_cast<std::uint32_t>(child));
      } else {
        open[count++] = {node.level - 1, child};
      }
    }
  }
}

void FaceBlocks::Near(const OrientedBox& box, std::vector<std::uint32_t>* blocks) const {
  const BoxInFloat in_float = OfBox(box);
  const auto boxes_near = FaceKernelsHere().boxes_near;
  Collect([&](const EightBoxes& boxes) { return boxes_near(boxes, in_float); }, blocks);
}

void FaceBlocks::NearFrom(std::uint32_t block, std::vector<std::uint32_t>* blocks) const {
  UprightBox box;
  const EightBoxes& boxes_of = levels_.front()[block / 8];
  for (int k = 0; k < 3; ++k) {
    box.low[k] = boxes_of.low[k][block % 8];
    box.high[k] = boxes_of.high[k][block % 8];
  }
  const auto touching = FaceKernelsHere().boxes_touching;
  Collect([&](const EightBoxes& boxes) { return touching(boxes, box); }, blocks, block);
}

std::array<unsigned char, 8> FaceBlocks::FacesTouching(std::uint32_t block,
                                                       std::uint32_t other) const {
  std::array<unsigned char, 8> masks;
  FaceKernelsHere().faces_touching(blocks_[block], blocks_[other], masks.data());
  return masks;
}

void FaceBlocks::TakeBoxes(NearFaces* near) const {
  near->boxes.assign((near->blocks.size() + 7) / 8, kNoBoxes);
  for (std::size_t i = 0; i < near->blocks.size(); ++i) {
    const EightBoxes& from = levels_.front()[near->blocks[i] / 8];
    for (int k = 0; k < 3; ++k) {
      near->boxes[i / 8].low[k][i % 8] = from.low[k][near->blocks[i] % 8];
      near->boxes[i / 8].high[k][i % 8] = from.high[k][near->blocks[i] % 8];
    }
  }
}

void FaceBlocks::NearBox(const OrientedBox& box, NearFaces* near) const {
  near->blocks.clear();
  Near(box, &near->blocks);
  TakeBoxes(near);
}

void FaceBlocks::NearLine(const Vector3d& origin, const Vector3d& direction, double length,
                          NearFaces* near) const {
  near->blocks.clear();
  const RayInFloat ray = InFloat(origin, direction, length);
  const auto boxes_met = FaceKernelsHere().boxes_met;
  Collect([&](const EightBoxes& boxes) { return boxes_met(ray, boxes); }, &near->blocks);
  TakeBoxes(near);
}

bool FaceBlocks::CanCast() const {
  constexpr double kFar = 1e6;
  return FaceKernelsHere().faces_met != nullptr && radius_ > 1.0 / kFar && radius_ < kFar;
}

int FaceBlocks::Met(const Vector3d& origin, const Vector3d& direction, double length,
                    const NearFaces& near, std::span<std::uint32_t> slots) const {
  return FaceKernelsHere().faces_met(
      InFloat(origin, direction, length),
      {near.boxes.data(), near.blocks.data(), static_cast<int>(near.boxes.size())}, blocks_.data(),
      slots.data(), static_cast<int>(slots.size()));
}

unsigned FaceBlocks::FacesIn(std::uint32_t block, const BoxInFloat& box) const {
  return FaceKernelsHere().faces_in(blocks_[block], box);
}

}  // namespace antigrasp
