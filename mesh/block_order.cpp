#include "antigrasp/mesh/block_order.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <span>

namespace antigrasp {
namespace {

using Eigen::Vector3f;

// One as a whole, to be moved at once.
using FaceWhole = std::uint32_t __attribute__((vector_size(16)));
static_assert(sizeof(FaceWhole) == sizeof(FaceMiddle));

// Moves those that belong to the front there and returns how many they are. Without a branch on
// what cannot be foretold: every one changes places with the first that stays.
template <typename Belongs>
std::size_t Part(std::span<FaceMiddle> faces, Eigen::Index axis, const Belongs& belongs) {
  std::size_t front = 0;
  for (FaceMiddle& face : faces) {
    const bool moves = belongs(face.at.data()[axis]);
    FaceWhole moved, stays;
    std::memcpy(&moved, &face, sizeof moved);
    std::memcpy(&stays, &faces[front], sizeof stays);
    std::memcpy(static_cast<void*>(&face), &stays, sizeof stays);
    std::memcpy(static_cast<void*>(&faces[front]), &moved, sizeof moved);
    front += moves ? 1 : 0;
  }
  return front;
}

float MedianOf(float a, float b, float c) {
  return std::max(std::min(a, b), std::min(std::max(a, b), c));
}

// As std::nth_element: what comes before `cut` lies no further along the axis than what comes
// after.
void CutAt(std::span<FaceMiddle> faces, std::size_t cut, Eigen::Index axis) {
  constexpr std::size_t kFew = 12;
  constexpr int kMostRounds = 48;
  for (int round = 0; round < kMostRounds && faces.size() > kFew; ++round) {
    const float pivot =
        MedianOf(faces.front().at[axis], faces[faces.size() / 2].at[axis], faces.back().at[axis]);
    std::size_t front = Part(faces, axis, [pivot](float at) { return at < pivot; });
    if (cut < front) {
      faces = faces.first(front);
      continue;
    }
    if (front == 0) {  // many may lie at one place
      front = Part(faces, axis, [pivot](float at) { return at <= pivot; });
      if (cut < front) return;
    }
    faces = faces.subspan(front);
    cut -= front;
  }
  std::nth_element(
      faces.begin(), faces.begin() + static_cast<std::ptrdiff_t>(cut), faces.end(),
      [axis](const FaceMiddle& x, const FaceMiddle& y) { return x.at[axis] < y.at[axis]; });
}

// Cuts until eight are left. To the left go 8 times a power of two: blocks in groups of eight, and
// groups in groups, are then what one cut left together.
void Sort(std::span<FaceMiddle> faces, Vector3f low, Vector3f high) {
  while (faces.size() > 8) {
    const std::size_t left = 8 * std::bit_floor((faces.size() + 7) / 8 - 1);
    Eigen::Index axis;
    (high - low).maxCoeff(&axis);
    CutAt(faces, left, axis);
    Vector3f middle = high;
    middle[axis] = faces[left].at[axis];
    Sort(faces.first(left), low, middle);
    low[axis] = middle[axis];
    faces = faces.subspan(left);
  }
}

}  // namespace

std::vector<FaceMiddle> BlockOrder(const std::vector<Vector3f>& vertices,
                                   const std::vector<std::array<std::int32_t, 3>>& corners,
                                   const Eigen::AlignedBox3f& box) {
  std::vector<FaceMiddle> faces(corners.size());
  for (std::size_t i = 0; i < faces.size(); ++i) {
    Vector3f sum = Vector3f::Zero();
    for (const std::int32_t v : corners[i]) sum += vertices[static_cast<std::size_t>(v)];
    faces[i] = {sum / 3.0f, static_cast<std::uint32_t>(i)};
  }
  Sort(faces, box.min(), box.max());
  return faces;
}

}  // namespace antigrasp
