#include "antigrasp/datasets/objects.h"

#include <algorithm>
#include <functional>
#include <map>
#include <memory>
#include <set>

#include "antigrasp/core/error.h"
#include "antigrasp/datasets/mesh_folder.h"
#include "antigrasp/datasets/shape_set.h"
#include "antigrasp/mesh/mesh_file.h"
#include "antigrasp/mesh/mesh_format.h"
#include "antigrasp/mesh/repair.h"
#include "antigrasp/sdf/remesh.h"

namespace antigrasp {
namespace {

namespace fs = std::filesystem;

std::string Expected() {
  return "a mesh (" + Alternatives(ReadableExtensions(), ".") +
         "), a folder of meshes or an antigrasp SDF file";
}

void AddNote(const std::string& note, InputObject* object) {
  object->note += (object->note.empty() ? "" : "; ") + note;
}

InputObject FromMesh(const TriangleMesh& mesh) {
  const RepairResult repaired = Repair(mesh);
  InputObject object;
  object.mesh = repaired.mesh;
  object.status = repaired.accepted() ? "ok" : repaired.refusal;
  for (const std::string& action : repaired.actions) AddNote(action, &object);
  return object;
}

InputObject FromFile(const fs::path& path) {
  std::vector<std::string> read_otherwise;
  InputObject object = FromMesh(ReadMesh(path, &read_otherwise));
  for (const std::string& note : read_otherwise) AddNote(note, &object);
  return object;
}

InputObject FromGrid(const SdfGrid& grid) {
  RemeshResult result = Remesh(grid);
  InputObject object;
  object.mesh = std::move(result.mesh);
  object.status = std::string(Name(result.status));
  return object;
}

// An unreadable mesh in a folder is no reason to leave the others.
InputObject FromFileInFolder(const fs::path& file) {
  try {
    return FromFile(file);
  } catch (const InputError& error) {
    InputObject object;
    object.status = "not readable";
    object.note = error.what();
    return object;
  }
}

// One object before it has a name of its own.
struct Found {
  ObjectOrigin origin;
  fs::path file;
  std::function<InputObject()> load;
};

std::vector<Found> FindIn(const std::string& input) {
  const fs::path path(input);
  std::vector<Found> found;
  if (fs::is_directory(path)) {
    for (const fs::path& file : MeshFilesIn(path)) {
      found.push_back({{file.lexically_relative(path).string(), path}, file, [file] {
                         return FromFileInFolder(file);
                       }});
    }
  } else if (!fs::exists(path)) {
    throw InputError("no such file or folder", input, Expected());
  } else if (IsShapeSet(path)) {
    const auto set = std::make_shared<ShapeSetReader>(path);
    const fs::path folder = fs::path(path).replace_extension();
    for (std::string& name : set->Names()) {
      const int grid = static_cast<int>(found.size());
      found.push_back(
          {{std::move(name), folder}, path, [set, grid] { return FromGrid(set->Grid(grid)); }});
    }
  } else if (IsMeshFile(path)) {
    found.push_back({{path.filename().string(), fs::absolute(path).parent_path()}, path, [path] {
                       return FromFile(path);
                     }});
  } else {
    ReadShapeSetInfo(path);  // says what keeps it from being an SDF file
    throw InputError("unknown kind of file", input, Expected());
  }
  return found;
}

}  // namespace

struct ObjectSource::Source {
  std::string name;
  std::size_t input;
  fs::path file;
  std::function<InputObject()> load;
};

ObjectSource::ObjectSource(const std::vector<std::string>& inputs) {
  std::vector<ObjectOrigin> origins;
  for (std::size_t input = 0; input < inputs.size(); ++input) {
    for (Found& found : FindIn(inputs[input])) {
      origins.push_back(std::move(found.origin));
      sources_.push_back({"", input, std::move(found.file), std::move(found.load)});
    }
  }
  if (sources_.empty()) throw InputError("no object", inputs.front(), Expected());
  std::vector<std::string> names = DistinctNames(origins);
  for (std::size_t i = 0; i < names.size(); ++i) sources_[i].name = std::move(names[i]);
}

ObjectSource::~ObjectSource() = default;

std::int64_t ObjectSource::size() const { return std::ssize(sources_); }

const std::string& ObjectSource::name(std::int64_t i) const {
  return sources_[static_cast<std::size_t>(i)].name;
}

std::size_t ObjectSource::input(std::int64_t i) const {
  return sources_[static_cast<std::size_t>(i)].input;
}

InputObject ObjectSource::Load(std::int64_t i) const {
  InputObject object = sources_[static_cast<std::size_t>(i)].load();
  object.name = name(i);
  return object;
}

void ObjectSource::RequireNotRead(const std::vector<fs::path>& written) const {
  std::set<fs::path> read;
  for (const Source& source : sources_) read.insert(fs::weakly_canonical(source.file));
  for (const fs::path& path : written) {
    if (path.empty() || !read.contains(fs::weakly_canonical(path))) continue;
    throw InputError("would be written over an object's file", path.string(), "another --out");
  }
}

std::vector<InputObject> LoadObjects(const ObjectSource& source, int threads,
                                     const ProgressFn& progress, std::size_t limit) {
  const auto all = static_cast<std::size_t>(source.size());
  std::vector<InputObject> objects(limit > 0 ? std::min(limit, all) : all);
  ParallelFor(
      std::ssize(objects), threads,
      [&](std::int64_t i) { objects[static_cast<std::size_t>(i)] = source.Load(i); }, progress);
  return objects;
}

std::vector<InputObject> LoadObjects(const std::vector<std::string>& inputs, int threads,
                                     const ProgressFn& progress, std::size_t limit) {
  return LoadObjects(ObjectSource(inputs), threads, progress, limit);
}

std::string CountByStatus(const std::vector<std::string>& statuses) {
  std::map<std::string, int> counts;
  for (const std::string& status : statuses) ++counts[status];
  std::string text =
      std::to_string(statuses.size()) + " objects: " + std::to_string(counts["ok"]) + " ok";
  for (const auto& [status, count] : counts) {
    if (status != "ok") text += ", " + std::to_string(count) + " " + status;
  }
  return text;
}

}  // namespace antigrasp
