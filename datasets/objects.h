#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "antigrasp/core/parallel.h"
#include "antigrasp/datasets/object_names.h"
#include "antigrasp/mesh/length_unit.h"
#include "antigrasp/mesh/triangle_mesh.h"

namespace antigrasp {

// One object named on the command line, however it came: a mesh file, a mesh in a folder, a grid.
struct InputObject {
  std::string name;
  TriangleMesh mesh;
  std::string status;  // "ok", or why there is no usable solid ("open: 12 boundary edges", ...)
  std::string note;    // what was repaired; may be empty
  std::uint64_t stream = 0;  // of its random draws: StreamOf its own name, beside any others
  bool ok() const { return status == "ok"; }
};

// The unit of meshes that are read from the grids of an SDF file.
enum class GridUnit {
  kOfFiles,  // that of the meshes which were imported, where the file knows it (/sdf@side)
  kCube      // the side of the cube: sets that lie in it are alike
};

// The objects of mesh files, folders (searched recursively) and SDF files, in the order given,
// sorted inside a folder. Their names are known at once and told apart (DistinctNames); an object
// is read when it is asked for, so that memory need not grow with their number.
class ObjectSource {
 public:
  // InputError for a missing path, for a file of unknown kind and for no object at all.
  // `into`: the unit that meshes are turned into whose files know their own (3MF, GLB), so that
  // files of any are at true size side by side; none: they are read as they are.
  explicit ObjectSource(const std::vector<std::string>& inputs, GridUnit unit = GridUnit::kOfFiles,
                        std::optional<LengthUnit> into = std::nullopt);
  ~ObjectSource();
  std::int64_t size() const;
  const std::string& name(std::int64_t i) const;
  std::size_t input(std::int64_t i) const;     // which of the inputs it came with
  std::uint64_t stream(std::int64_t i) const;  // InputObject::stream
  std::vector<std::uint64_t> streams() const;  // of all
  // Any thread may call. A mesh is usable when it is a solid after repair (mesh/repair.h).
  // InputError for an unreadable file that was named itself and for a damaged grid; an unreadable
  // mesh inside a folder is an object with that status.
  InputObject Load(std::int64_t i) const;
  // InputError when one of the files to be written is a file that objects are read from.
  void RequireNotRead(const std::vector<std::filesystem::path>& written) const;
  // InputError when meshes that are written into this folder would be objects of the next call: it
  // is, or lies in, a folder that is searched.
  void RequireNotSearched(const std::filesystem::path& folder) const;

 private:
  struct Input;   // an SDF file, a folder or a mesh file
  struct Source;  // an object of one
  void Open(const std::string& path, std::vector<ObjectOrigin>* origins);

  GridUnit unit_;
  std::optional<LengthUnit> into_;
  std::vector<Input> inputs_;
  std::vector<Source> sources_;
};

// All at once, or the first `limit` of them (0 = all).
std::vector<InputObject> LoadObjects(const ObjectSource& source, int threads,
                                     const ProgressFn& progress = nullptr, std::size_t limit = 0);
std::vector<InputObject> LoadObjects(const std::vector<std::string>& inputs, int threads,
                                     const ProgressFn& progress = nullptr, std::size_t limit = 0);

// Which original every object has: alone they pair up whatever they are called, else by name
// without the extension. InputError for an object without an original.
std::vector<std::int64_t> PairWithOriginals(const ObjectSource& objects,
                                            const ObjectSource& originals);

// "a.stl and b.stl are taken as a pair, ..."; empty unless one object pairs up with one of another
// name.
std::string OtherNamesText(const ObjectSource& objects, const ObjectSource& originals);

// "12 objects: 10 ok, 1 empty, 1 open: 4 boundary edges", of their statuses.
std::string CountByStatus(const std::vector<std::string>& statuses);

}  // namespace antigrasp
