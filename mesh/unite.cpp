#include "antigrasp/mesh/unite.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "antigrasp/mesh/clean_faces.h"
#include "antigrasp/mesh/mesh_union.h"
#include "antigrasp/mesh/self_intersection.h"
#include "antigrasp/mesh/slivers.h"
#include "antigrasp/mesh/topology.h"
#include "antigrasp/mesh/weld.h"

namespace antigrasp {
namespace {

using Group = std::vector<std::size_t>;  // of pieces

std::vector<Group> GroupsOf(const Orientation& orientation) {
  std::vector<Group> groups;
  for (std::size_t p = 0; p < orientation.group.size(); ++p) {
    const auto group = static_cast<std::size_t>(orientation.group[p]);
    if (groups.size() <= group) groups.resize(group + 1);
    groups[group].push_back(p);
  }
  std::erase_if(groups, [](const Group& group) { return group.empty(); });
  return groups;
}

bool CanUnite(const Group& group, const Orientation& orientation) {
  return std::all_of(group.begin(), group.end(), [&](std::size_t p) {
    return !orientation.crosses_itself[p] &&
           orientation.inward[p] == orientation.inward[group.front()];
  });
}

std::optional<TriangleMesh> UnionOf(const Group& group, std::vector<TriangleMesh>* parts) {
  std::vector<TriangleMesh> meshes;
  const bool inward = Volume((*parts)[group.front()]) < 0.0;
  for (const std::size_t p : group) {
    meshes.push_back(std::move((*parts)[p]));
    if (inward) TurnOver(&meshes.back());
  }
  std::optional<TriangleMesh> one = Union(meshes);
  if (one && inward) TurnOver(&*one);
  return one;
}

// Corners of the exact union this close, relative to the diagonal, are one in double, or next to
// it: between them are needles without area, and beside it faces that rounding has flattened.
constexpr double kRoundedCorner = 1e-12;

void Weld(TriangleMesh* mesh) {
  Redirect(FirstNear(mesh->vertices, kRoundedCorner * Bounds(*mesh).Extent().norm()), mesh);
  DropLines(mesh);
  DropCopies(mesh);
  DropUnusedVertices(mesh);
  FlipSlivers(mesh);
}

}  // namespace

std::size_t UniteGroups(const Orientation& orientation, TriangleMesh* mesh) {
  const std::vector<Group> groups = GroupsOf(orientation);
  std::size_t united = 0;
  for (const Group& group : groups) {
    if (group.size() == 1) continue;
    if (!CanUnite(group, orientation)) return 0;
    united += group.size();
  }
  if (united == 0) return 0;
  std::vector<TriangleMesh> parts = Apart(*mesh, orientation.pieces);
  TriangleMesh whole;
  for (const Group& group : groups) {
    if (group.size() == 1) {
      Append(parts[group.front()], &whole);
    } else {
      const std::optional<TriangleMesh> one = UnionOf(group, &parts);
      if (!one) return 0;
      Append(*one, &whole);
    }
  }
  Weld(&whole);
  if (!CountEdges(whole).Closed() || SelfIntersects(whole)) return 0;
  // What lay in two of the pieces lies in one now: whether it is matter is no longer known.
  if (OrientFaces(&whole, true).turned > 0) return 0;
  *mesh = std::move(whole);
  return united;
}

}  // namespace antigrasp
