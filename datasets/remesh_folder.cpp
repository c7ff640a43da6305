#include "antigrasp/datasets/remesh_folder.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/csv_writer.h"
#include "antigrasp/core/ordered_stream.h"
#include "antigrasp/core/spool.h"
#include "antigrasp/datasets/objects.h"
#include "antigrasp/datasets/result_folder.h"
#include "antigrasp/datasets/shape_set.h"
#include "antigrasp/mesh/mesh_file.h"
#include "antigrasp/sdf/mesh_to_sdf.h"

namespace antigrasp {
namespace {

// Exact distances to the meshes, set aside until it is known how many there are.
class RemeshedGrids {
 public:
  RemeshedGrids(const RemeshRequest& request, const ShapeSetInfo& info)
      : path_(request.grids), spool_(request.grids + ".grids"), shared_(UnitCubeGrid(info.n)) {
    about_ = {info.kind, info.seed, "exact distances to the meshes of " + request.input};
    about_.side = info.side;
  }
  SdfGrid Of(const TriangleMesh& mesh) const {
    SdfGrid grid = shared_;
    MeshToSdf(mesh, &grid);
    return grid;
  }
  void Add(const std::string& name, const SdfGrid& grid) {
    spool_.Append(grid.values.data(), grid.values.size() * sizeof(float));
    names_.push_back(name);
  }
  void Commit() {
    if (names_.empty()) return;
    ShapeSetWriter writer(path_, about_, names_.size());
    const std::size_t bytes = shared_.values.size() * sizeof(float);
    for (std::size_t i = 0; i < names_.size(); ++i) {
      spool_.Read(i * bytes, shared_.values.data(), bytes);
      writer.Add(names_[i], shared_);
    }
    writer.Commit();
  }

 private:
  std::string path_;
  Spool spool_;
  SdfGrid shared_;
  ShapeSet about_;
  std::vector<std::string> names_;
};

}  // namespace

RemeshedFolder RemeshIntoFolder(const RemeshRequest& request, const ProgressFn& progress) {
  const ShapeSetInfo info = ReadShapeSetInfo(request.input);  // only these have what to remesh
  const ObjectSource objects({request.input}, GridUnit::kCube);
  std::optional<RemeshedGrids> grids;
  if (!request.grids.empty()) {
    RequireShapeSetName(request.grids);
    objects.RequireNotRead({request.grids});
    grids.emplace(request, info);
  }
  ResultFolder results(request.out, {"remesh.csv", {}, {"NAME." + request.format}}, objects,
                       request.overwrite);
  CsvWriter csv({"object", "status", "vertices", "faces", "volume", "area", "file"});
  std::vector<std::string> statuses;
  StreamInOrder(
      objects.size(), request.threads,
      [&](std::int64_t i) {
        InputObject object = objects.Load(i);
        SdfGrid grid = grids && object.ok() ? grids->Of(object.mesh) : SdfGrid{};
        return std::pair(std::move(object), std::move(grid));
      },
      [&](std::int64_t, const std::pair<InputObject, SdfGrid>& remeshed) {
        const auto& [object, grid] = remeshed;
        csv.Text(object.name).Text(object.status).Count(std::ssize(object.mesh.vertices));
        csv.Count(std::ssize(object.mesh.faces));
        csv.Numbers({Volume(object.mesh), SurfaceArea(object.mesh)});
        const std::string file = FileNameOf(object.name) + "." + request.format;
        csv.Text(object.ok() ? file : "").EndRow();
        results.AddToTable(csv.TakeText());
        statuses.push_back(object.status);
        if (object.ok()) WriteMesh(results.path() / file, object.mesh);
        if (object.ok() && grids) grids->Add(object.name, grid);
      },
      progress);
  if (grids) grids->Commit();
  results.Commit(csv.TakeText());
  return {CountByStatus(statuses),
          std::find(statuses.begin(), statuses.end(), "ok") != statuses.end(), results.table()};
}

}  // namespace antigrasp
