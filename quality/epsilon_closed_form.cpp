#include "antigrasp/quality/epsilon_closed_form.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace antigrasp {
namespace {

using Directions = std::array<std::array<double, kPyramidLanes>, 2>;  // cosines, sines

// Directions of the polar pyramid's edges; short of 8 the last is repeated, which adds vertices
// where one already is and sides without length.
Directions PyramidDirections(int cone_edges) {
  Directions directions;
  for (int lane = 0; lane < kPyramidLanes; ++lane) {
    const double angle = (2 * std::min(lane, cone_edges - 1) + 1) * std::numbers::pi / cone_edges;
    directions[0][static_cast<std::size_t>(lane)] = std::cos(angle);
    directions[1][static_cast<std::size_t>(lane)] = std::sin(angle);
  }
  return directions;
}

const Directions& DirectionsFor(int cone_edges) {
  static const auto table = [] {
    std::array<Directions, kPyramidLanes + 1> all;
    for (int edges = 3; edges <= kPyramidLanes; ++edges) {
      all[static_cast<std::size_t>(edges)] = PyramidDirections(edges);
    }
    return all;
  }();
  return table[static_cast<std::size_t>(cone_edges)];
}

void Copy(const Eigen::Vector3d& from, double* to) { std::copy_n(from.data(), 3, to); }

PyramidInput ToPyramidInput(const DualMap& map) {
  PyramidInput input;
  const Directions& directions = DirectionsFor(map.cone_edges);
  std::copy_n(directions[0].data(), kPyramidLanes, input.cosine);
  std::copy_n(directions[1].data(), kPyramidLanes, input.sine);
  input.inset = map.inset;
  for (std::size_t i = 0; i < 2; ++i) {
    Copy(map.inward[i], input.inward[i]);
    Copy(map.frames[i][0], input.t1[i]);
    Copy(map.frames[i][1], input.t2[i]);
    Copy(map.apex[i], input.apex[i]);
    input.along[i] = map.along[i];
  }
  Copy(map.line, input.line);
  Copy(map.arm, input.arm);
  Copy(map.kernel_force, input.kernel_force);
  input.length = map.length;
  input.torque_scale = map.torque_scale;
  input.kernel2 = map.kernel2;
  input.base = static_cast<int>(map.base);
  input.a = map.a;
  input.b = map.b;
  input.e = map.e;
  return input;
}

PyramidKernel KernelOf(SimdLevel level) {
  switch (level) {
    case SimdLevel::kAvx512:
      return MaxNorm2PyramidAvx512;
    case SimdLevel::kAvx2:
      return MaxNorm2PyramidAvx2;
    case SimdLevel::kBaseline:
      return MaxNorm2PyramidBaseline;
  }
  return MaxNorm2PyramidBaseline;
}

std::optional<double> Run(const DualMap& map, PyramidKernel kernel) {
  if (map.cone_edges > kPyramidLanes) return std::nullopt;
  const double norm2 = kernel(ToPyramidInput(map));
  if (!(norm2 >= 0.0)) return std::nullopt;
  return norm2;
}

}  // namespace

const char* Name(SimdLevel level) {
  switch (level) {
    case SimdLevel::kAvx512:
      return "avx512";
    case SimdLevel::kAvx2:
      return "avx2";
    case SimdLevel::kBaseline:
      return "baseline";
  }
  return "unknown";
}

const std::vector<SimdLevel>& SupportedSimdLevels() {
  static const std::vector<SimdLevel> levels = [] {
    std::vector<SimdLevel> found{SimdLevel::kBaseline};
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx2")) found.push_back(SimdLevel::kAvx2);
    if (__builtin_cpu_supports("avx512f")) found.push_back(SimdLevel::kAvx512);
#endif
    return found;
  }();
  return levels;
}

std::optional<double> MaxNorm2ClosedForm(const DualMap& map) {
  static const PyramidKernel kernel = KernelOf(SupportedSimdLevels().back());
  return Run(map, kernel);
}

std::optional<double> MaxNorm2ClosedForm(const DualMap& map, SimdLevel level) {
  return Run(map, KernelOf(level));
}

}  // namespace antigrasp
