#include "antigrasp/datasets/remesh_folder.h"

#include <algorithm>
#include <vector>

#include "antigrasp/core/csv_writer.h"
#include "antigrasp/core/ordered_stream.h"
#include "antigrasp/datasets/objects.h"
#include "antigrasp/datasets/result_folder.h"
#include "antigrasp/datasets/shape_set.h"
#include "antigrasp/mesh/mesh_file.h"

namespace antigrasp {

RemeshedFolder RemeshIntoFolder(const RemeshRequest& request, const ProgressFn& progress) {
  ReadShapeSetInfo(request.input);  // only SDF files have something to remesh
  const ObjectSource objects({request.input}, GridUnit::kCube);
  ResultFolder results(request.out, {"remesh.csv", {}, {"NAME." + request.format}}, objects,
                       request.overwrite);
  CsvWriter csv({"object", "status", "vertices", "faces", "volume", "area", "file"});
  std::vector<std::string> statuses;
  StreamInOrder(
      objects.size(), request.threads, [&](std::int64_t i) { return objects.Load(i); },
      [&](std::int64_t, const InputObject& object) {
        csv.Text(object.name).Text(object.status).Count(std::ssize(object.mesh.vertices));
        csv.Count(std::ssize(object.mesh.faces));
        csv.Numbers({Volume(object.mesh), SurfaceArea(object.mesh)});
        const std::string file = FileNameOf(object.name) + "." + request.format;
        csv.Text(object.ok() ? file : "").EndRow();
        results.AddToTable(csv.TakeText());
        statuses.push_back(object.status);
        if (object.ok()) WriteMesh(results.path() / file, object.mesh);
      },
      progress);
  results.Commit(csv.TakeText());
  return {CountByStatus(statuses),
          std::find(statuses.begin(), statuses.end(), "ok") != statuses.end(), results.table()};
}

}  // namespace antigrasp
