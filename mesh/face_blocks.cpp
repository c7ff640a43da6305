#include "antigrasp/mesh/face_blocks.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <limits>

#include "antigrasp/mesh/block_order.h"

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

// Beyond that rounding leaves the sides of ever more faces open, and they would take 76 bytes a
// face.
constexpr std::size_t kMostWithSides = 8192;

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

Eigen::Matrix3d AxesAlong(const Vector3d& direction) {
  Eigen::Matrix3d axes;
  axes.col(0) = direction;
  axes.col(1) = direction.unitOrthogonal();
  axes.col(2) = direction.cross(axes.col(1));
  return axes;
}

RayInFloat InFloat(const LocalRay& ray) {
  RayInFloat in_float;
  for (int k = 0; k < 3; ++k) {
    in_float.origin[k] = static_cast<float>(ray.origin[k]);
    in_float.direction[k] = static_cast<float>(ray.direction[k]);
  }
  in_float.length = static_cast<float>(ray.length);
  return in_float;
}

// Around the ray's segment, along the columns of `axes`.
UprightBox BoxOf(const LocalRay& ray, const Eigen::Matrix3d& axes, double slack) {
  UprightBox box;
  for (int k = 0; k < 3; ++k) {
    const double start = axes.col(k).dot(ray.origin);
    const double end = start + ray.length * axes.col(k).dot(ray.direction);
    box.low[k] = static_cast<float>(std::min(start, end) - slack);
    box.high[k] = static_cast<float>(std::max(start, end) + slack);
  }
  return box;
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
  const std::vector<FaceMiddle> order = BlockOrder(vertices, corners, bounds);
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
  if (blocks_.size() <= kMostWithSides && FaceKernelsHere().take_sides != nullptr) {
    sides_.resize(blocks_.size());
    for (std::size_t i = 0; i < blocks_.size(); ++i) {
      FaceKernelsHere().take_sides(blocks_[i], &sides_[i]);
    }
  }
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

void FaceBlocks::TakeBoxes(const Eigen::Matrix3d& axes, NearFaces* near) const {
  near->axes = axes;
  near->boxes.assign((near->blocks.size() + 7) / 8, kNoBoxes);
  for (std::size_t i = 0; i < near->blocks.size(); ++i) {
    const EightBoxes& from = levels_.front()[near->blocks[i] / 8];
    for (int k = 0; k < 3; ++k) {
      near->boxes[i / 8].low[k][i % 8] = from.low[k][near->blocks[i] % 8];
      near->boxes[i / 8].high[k][i % 8] = from.high[k][near->blocks[i] % 8];
    }
  }
  float in_float[3][3];
  for (int a = 0; a < 3; ++a) {
    for (int k = 0; k < 3; ++k) in_float[a][k] = static_cast<float>(axes(k, a));
  }
  const auto turn_boxes = FaceKernelsHere().turn_boxes;
  for (EightBoxes& boxes : near->boxes) turn_boxes(in_float, &boxes);
  near->blocks.resize(8 * near->boxes.size(), 0);
}

void FaceBlocks::NearBox(const OrientedBox& box, NearFaces* near) const {
  near->blocks.clear();
  Near(box, &near->blocks);
  TakeBoxes(box.axes, near);
}

void FaceBlocks::NearLine(const LocalRay& ray, NearFaces* near) const {
  near->blocks.clear();
  const RayInFloat in_float = InFloat(ray);
  const auto boxes_met = FaceKernelsHere().boxes_met;
  Collect([&](const EightBoxes& boxes) { return boxes_met(in_float, boxes); }, &near->blocks);
  TakeBoxes(AxesAlong(ray.direction), near);
}

bool FaceBlocks::CanCast() const {
  constexpr double kFar = 1e6;
  return FaceKernelsHere().faces_met != nullptr && radius_ > 1.0 / kFar && radius_ < kFar;
}

void FaceBlocks::Met(std::span<const LocalRay> rays, const NearFaces& near, Slots* met) const {
  RayInFloat in_float[kTogether];
  UprightBox segments[kTogether];
  for (std::size_t i = 0; i < rays.size(); ++i) {
    in_float[i] = InFloat(rays[i]);
    const double slack = kFloatSlack * (radius_ + rays[i].origin.lpNorm<1>() + rays[i].length);
    segments[i] = BoxOf(rays[i], near.axes, slack);
  }
  FaceKernelsHere().faces_met(
      {in_float, segments, static_cast<int>(rays.size())},
      {near.boxes.data(), near.blocks.data(), static_cast<int>(near.boxes.size())},
      {blocks_.data(), sides_.empty() ? nullptr : sides_.data(), static_cast<float>(radius_)},
      {met->counts, met->slots[0], kMostMet});
}

unsigned FaceBlocks::FacesIn(std::uint32_t block, const BoxInFloat& box) const {
  return FaceKernelsHere().faces_in(blocks_[block], box);
}

}  // namespace antigrasp
