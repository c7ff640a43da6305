#include "antigrasp/sdf/remesh.h"

#include <algorithm>
#include <cmath>

#include "antigrasp/core/check.h"
#include "antigrasp/sdf/marching_cubes.h"

namespace antigrasp {
namespace {

bool BorderNodeInside(const SdfGrid& grid) {
  const int last = grid.n - 1;
  for (int a = 0; a <= last; ++a) {
    for (int b = 0; b <= last; ++b) {
      for (const int end : {0, last}) {
        if (grid.values[grid.Index(end, a, b)] > 0.0F ||
            grid.values[grid.Index(a, end, b)] > 0.0F ||
            grid.values[grid.Index(a, b, end)] > 0.0F) {
          return true;
        }
      }
    }
  }
  return false;
}

RemeshStatus MeshStatus(const MeshReport& report) {
  if (!report.closed) return RemeshStatus::kGaps;
  if (!report.manifold) return RemeshStatus::kNonManifold;
  if (!report.orientable) return RemeshStatus::kNonOrientable;
  if (report.self_intersecting) return RemeshStatus::kSelfIntersecting;
  if (report.components - report.voids > 1) return RemeshStatus::kDisjoint;
  return RemeshStatus::kOk;
}

}  // namespace

std::string_view Name(RemeshStatus status) {
  switch (status) {
    case RemeshStatus::kOk:
      return "ok";
    case RemeshStatus::kNonFinite:
      return "non_finite";
    case RemeshStatus::kEmpty:
      return "empty";
    case RemeshStatus::kTouchesBorder:
      return "touches_border";
    case RemeshStatus::kGaps:
      return "gaps";
    case RemeshStatus::kNonManifold:
      return "non_manifold";
    case RemeshStatus::kNonOrientable:
      return "non_orientable";
    case RemeshStatus::kSelfIntersecting:
      return "self_intersecting";
    case RemeshStatus::kDisjoint:
      return "disjoint";
  }
  AG_CHECK(false, "unknown remesh status");
}

RemeshResult Remesh(const SdfGrid& grid, const RemeshOptions& options) {
  const auto n = static_cast<std::size_t>(std::max(grid.n, 0));
  AG_CHECK(n > 0 && grid.values.size() == n * n * n, "grid size");
  RemeshResult result;
  const auto& values = grid.values;
  if (!std::all_of(values.begin(), values.end(), [](float v) { return std::isfinite(v); })) {
    result.status = RemeshStatus::kNonFinite;
    return result;
  }
  if (std::none_of(values.begin(), values.end(), [](float v) { return v > 0.0F; })) {
    result.status = RemeshStatus::kEmpty;
    return result;
  }
  result.mesh = MarchingCubes(grid);
  result.report = Inspect(result.mesh, options.check_self_intersection);
  result.status = options.reject_border && BorderNodeInside(grid) ? RemeshStatus::kTouchesBorder
                                                                  : MeshStatus(result.report);
  return result;
}

}  // namespace antigrasp
