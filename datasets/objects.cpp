#include "antigrasp/datasets/objects.h"

#include <algorithm>
#include <map>
#include <memory>
#include <set>
#include <utility>

#include "antigrasp/core/error.h"
#include "antigrasp/core/file_kind.h"
#include "antigrasp/datasets/mesh_folder.h"
#include "antigrasp/datasets/mesh_object.h"
#include "antigrasp/datasets/shape_set.h"
#include "antigrasp/mesh/mesh_file.h"
#include "antigrasp/mesh/mesh_format.h"
#include "antigrasp/sdf/remesh.h"

namespace antigrasp {
namespace {

namespace fs = std::filesystem;

std::string Expected() {
  return "a mesh (" + Alternatives(ReadableExtensions(), ".") +
         "), a folder of meshes or an antigrasp SDF file";
}

InputObject FromGrid(const SdfGrid& grid) {
  RemeshResult result = Remesh(grid);
  InputObject object;
  object.mesh = std::move(result.mesh);
  object.status = std::string(Name(result.status));
  return object;
}

// An unreadable mesh in a folder is no reason to leave the others.
InputObject FromFileInFolder(const fs::path& file, std::optional<LengthUnit> into) {
  try {
    return ObjectOf(ReadMeshFile(file), into);
  } catch (const InputError& error) {
    InputObject object;
    object.status = "not readable";
    object.note = error.what();
    return object;
  }
}

}  // namespace

struct ObjectSource::Input {
  std::string path;
  bool is_folder;
  std::unique_ptr<const ShapeSetReader> set;  // of an SDF file
};

// Little, because there may be very many.
struct ObjectSource::Source {
  std::string name;
  std::size_t input;
  std::uint64_t stream;
  int grid;          // of an SDF file
  std::string file;  // of a mesh
};

void ObjectSource::Open(const std::string& path, std::vector<ObjectOrigin>* origins) {
  const std::size_t number = inputs_.size();
  inputs_.push_back({path, fs::is_directory(path), nullptr});
  if (inputs_.back().is_folder) {
    for (const fs::path& file : MeshFilesIn(path)) {
      sources_.push_back({"", number, 0, 0, file.string()});
      origins->push_back({file.lexically_relative(path).string(), path});
    }
  } else if (!fs::exists(path)) {
    throw InputError("no such file or folder", path, Expected());
  } else if (IsShapeSet(path)) {
    inputs_.back().set = std::make_unique<ShapeSetReader>(path);
    const std::string folder = fs::path(path).replace_extension().string();
    int grid = 0;
    for (std::string& name : inputs_.back().set->Names()) {
      sources_.push_back({"", number, 0, grid++, ""});
      origins->push_back({std::move(name), folder});
    }
  } else if (IsMeshFile(path)) {
    sources_.push_back({"", number, 0, 0, path});
    origins->push_back(
        {fs::path(path).filename().string(), fs::absolute(path).parent_path().string()});
  } else {
    if (!IsHdf5(path)) RefuseOtherKind(path, FileKind::kMesh, "a mesh", Expected());
    ReadShapeSetInfo(path);  // says what keeps it from being an SDF file
    throw InputError("unknown kind of file", path, Expected());
  }
}

ObjectSource::ObjectSource(const std::vector<std::string>& inputs, GridUnit unit,
                           std::optional<LengthUnit> into)
    : unit_(unit), into_(into) {
  std::vector<ObjectOrigin> origins;
  for (const std::string& input : inputs) Open(input, &origins);
  if (sources_.empty()) throw InputError("no object", inputs.front(), Expected());
  std::vector<std::string> names = DistinctNames(origins);
  for (std::size_t i = 0; i < names.size(); ++i) {
    sources_[i].name = std::move(names[i]);
    sources_[i].stream = StreamOf(origins[i].name);
  }
}

ObjectSource::~ObjectSource() = default;

std::int64_t ObjectSource::size() const { return std::ssize(sources_); }

const std::string& ObjectSource::name(std::int64_t i) const {
  return sources_[static_cast<std::size_t>(i)].name;
}

std::size_t ObjectSource::input(std::int64_t i) const {
  return sources_[static_cast<std::size_t>(i)].input;
}

std::uint64_t ObjectSource::stream(std::int64_t i) const {
  return sources_[static_cast<std::size_t>(i)].stream;
}

std::vector<std::uint64_t> ObjectSource::streams() const {
  std::vector<std::uint64_t> streams;
  for (const Source& source : sources_) streams.push_back(source.stream);
  return streams;
}

InputObject ObjectSource::Load(std::int64_t i) const {
  const Source& source = sources_[static_cast<std::size_t>(i)];
  const Input& from = inputs_[source.input];
  InputObject object = from.set         ? FromGrid(from.set->Grid(source.grid))
                       : from.is_folder ? FromFileInFolder(source.file, into_)
                                        : ObjectOf(ReadMeshFile(source.file), into_);
  object.name = source.name;
  if (from.set && from.set->info().side > 0.0 && unit_ == GridUnit::kOfFiles) {
    object.mesh = Transformed(object.mesh, from.set->info().side, Eigen::Vector3d::Zero());
  }
  object.stream = source.stream;
  return object;
}

void ObjectSource::RequireNotRead(const std::vector<fs::path>& written) const {
  std::set<fs::path> read;
  for (const Input& input : inputs_) read.insert(fs::weakly_canonical(input.path));
  for (const Source& source : sources_) {
    if (inputs_[source.input].is_folder) read.insert(fs::weakly_canonical(source.file));
  }
  for (const fs::path& path : written) {
    if (path.empty() || !read.contains(fs::weakly_canonical(path))) continue;
    throw InputError("would be written over an object's file", path.string(), "another --out");
  }
}

void ObjectSource::RequireNotSearched(const fs::path& folder) const {
  const fs::path written = fs::weakly_canonical(fs::absolute(folder));
  for (const Input& input : inputs_) {
    if (!input.is_folder) continue;
    const fs::path searched = fs::canonical(input.path);
    const auto [end, ignored] =
        std::mismatch(searched.begin(), searched.end(), written.begin(), written.end());
    if (end != searched.end()) continue;
    throw InputError("meshes written there would be read by the next call", folder.string(),
                     "a folder outside of " + input.path);
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

std::vector<std::int64_t> PairWithOriginals(const ObjectSource& objects,
                                            const ObjectSource& originals) {
  if (objects.size() == 1 && originals.size() == 1) return {0};
  std::map<std::string, std::int64_t> place;  // names are told apart by their file names
  for (std::int64_t i = 0; i < originals.size(); ++i) place[FileNameOf(originals.name(i))] = i;
  std::vector<std::int64_t> pairs;
  for (std::int64_t i = 0; i < objects.size(); ++i) {
    const std::string name = FileNameOf(objects.name(i));
    const auto found = place.find(name);
    if (found == place.end()) {
      throw InputError("0 originals", "--baseline for " + objects.name(i),
                       "exactly one object named " + name);
    }
    pairs.push_back(found->second);
  }
  return pairs;
}

std::string OtherNamesText(const ObjectSource& objects, const ObjectSource& originals) {
  if (objects.size() > 1) return "";
  const std::string &object = objects.name(0), &original = originals.name(0);
  if (FileNameOf(object) == FileNameOf(original)) return "";
  return object + " and " + original +
         " are taken as a pair, though their names differ: there is one of each";
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
