#include "antigrasp/datasets/objects.h"

#include <algorithm>
#include <functional>
#include <map>

#include "antigrasp/core/error.h"
#include "antigrasp/datasets/shape_set.h"
#include "antigrasp/mesh/mesh_file.h"
#include "antigrasp/mesh/repair.h"
#include "antigrasp/sdf/remesh.h"

namespace antigrasp {
namespace {

namespace fs = std::filesystem;

constexpr const char* kExpected =
    "a mesh (STL, OBJ, PLY, OFF), a folder of meshes or an antigrasp SDF file";

// Where one object comes from; loading is put off so that it can run in parallel.
struct Source {
  std::string name;
  std::function<InputObject()> load;
};

InputObject FromMesh(const TriangleMesh& mesh) {
  const RepairResult repaired = Repair(mesh);
  InputObject object;
  object.mesh = repaired.mesh;
  const MeshReport& report = repaired.report;
  const bool usable = report.finite && report.closed && report.oriented && report.volume > 0.0;
  object.status = usable ? "ok" : repaired.refusal;
  for (const std::string& action : repaired.actions) {
    object.note += (object.note.empty() ? "" : "; ") + action;
  }
  if (usable && !repaired.refusal.empty()) {
    object.note += (object.note.empty() ? "" : "; ") + repaired.refusal;
  }
  return object;
}

InputObject FromGrid(const SdfGrid& grid) {
  RemeshResult result = Remesh(grid);
  InputObject object;
  object.mesh = std::move(result.mesh);
  object.status = std::string(Name(result.status));
  return object;
}

void AddFolder(const fs::path& folder, std::vector<Source>* sources) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file() && IsMeshFile(entry.path())) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  for (const fs::path& file : files) {
    sources->push_back({fs::relative(file, folder).string(), [file] {
                          try {
                            return FromMesh(ReadMesh(file));
                          } catch (const InputError& error) {
                            InputObject object;
                            object.status = "not readable";
                            object.note = error.what();
                            return object;
                          }
                        }});
  }
}

void AddShapeSet(const fs::path& path, std::vector<Source>* sources) {
  const auto set = std::make_shared<ShapeSet>(ReadShapeSet(path));
  for (std::size_t i = 0; i < set->grids.size(); ++i) {
    sources->push_back({set->names[i], [set, i] { return FromGrid(set->grids[i]); }});
  }
}

std::vector<Source> ListSources(const std::vector<std::string>& inputs) {
  std::vector<Source> sources;
  for (const std::string& input : inputs) {
    const fs::path path(input);
    if (fs::is_directory(path)) {
      AddFolder(path, &sources);
    } else if (!fs::exists(path)) {
      throw InputError("no such file or folder", input, kExpected);
    } else if (IsShapeSet(path)) {
      AddShapeSet(path, &sources);
    } else if (IsMeshFile(path)) {
      sources.push_back({path.filename().string(), [path] { return FromMesh(ReadMesh(path)); }});
    } else {
      ReadShapeSet(path);  // says what keeps it from being an SDF file
      throw InputError("unknown kind of file", input, kExpected);
    }
  }
  return sources;
}

}  // namespace

std::vector<InputObject> LoadObjects(const std::vector<std::string>& inputs, int threads,
                                     const ProgressFn& progress, std::size_t limit) {
  std::vector<Source> sources = ListSources(inputs);
  if (limit > 0 && sources.size() > limit) sources.resize(limit);
  if (sources.empty()) throw InputError("no object", inputs.front(), kExpected);
  std::vector<InputObject> objects(sources.size());
  ParallelFor(
      static_cast<std::int64_t>(sources.size()), threads,
      [&](std::int64_t i) {
        const auto slot = static_cast<std::size_t>(i);
        objects[slot] = sources[slot].load();
        objects[slot].name = sources[slot].name;
      },
      progress);
  return objects;
}

std::string FileNameOf(const std::string& object_name) {
  std::string name = object_name;
  if (IsMeshFile(name)) name = fs::path(name).replace_extension().string();
  std::replace(name.begin(), name.end(), '/', '_');
  return name;
}

std::string CountByStatus(const std::vector<InputObject>& objects) {
  std::map<std::string, int> counts;
  for (const InputObject& object : objects) ++counts[object.status];
  std::string text =
      std::to_string(objects.size()) + " objects: " + std::to_string(counts["ok"]) + " ok";
  for (const auto& [status, count] : counts) {
    if (status != "ok") text += ", " + std::to_string(count) + " " + status;
  }
  return text;
}

}  // namespace antigrasp
