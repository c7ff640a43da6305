#pragma once

#include <array>
#include <string_view>

#include "antigrasp/mesh/inspect.h"
#include "antigrasp/mesh/triangle_mesh.h"
#include "antigrasp/sdf/sdf_grid.h"

namespace antigrasp {

// Why a grid is no usable object (paper VI-C: "non-orientable faces, gaps, self-intersection, or
// disjoint pieces"). Order = order of the tests; the first that holds is the status.
enum class RemeshStatus {
  kOk,
  kNonFinite,
  kEmpty,
  kTouchesBorder,  // the surface leaves the grid: a border node is inside
  kGaps,           // an edge without two faces
  kNonManifold,    // a vertex with more than one fan
  kNonOrientable,
  kSelfIntersecting,
  kDisjoint,  // more than one body (a closed void is none)
};
inline constexpr int kNumRemeshStatuses = 9;
std::string_view Name(RemeshStatus status);  // "ok", "non_finite", "empty", ...

struct RemeshResult {
  TriangleMesh mesh;  // empty for kNonFinite and kEmpty
  MeshReport report;
  RemeshStatus status = RemeshStatus::kEmpty;
  bool ok() const { return status == RemeshStatus::kOk; }
};

struct RemeshOptions {
  bool check_self_intersection = true;  // 1 ms a mesh; the table makes it impossible inside a cell
  bool reject_border = true;
};

// Marching cubes and the watertightness check. A bad grid is data: counted, never an exception.
RemeshResult Remesh(const SdfGrid& grid, const RemeshOptions& options = {});

}  // namespace antigrasp
