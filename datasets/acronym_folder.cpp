#include "antigrasp/datasets/acronym_folder.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <set>
#include <system_error>

#include "antigrasp/core/throwaway_copy.h"
#include "antigrasp/datasets/hdf5_tree.h"
#include "antigrasp/datasets/mesh_folder.h"
#include "antigrasp/mesh/mesh_file.h"

namespace antigrasp {
namespace {

namespace fs = std::filesystem;

constexpr unsigned kMostSecondsOfAll = 600, kMostSecondsOfOne = 20;

std::vector<fs::path> GraspFilesIn(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::directory_iterator it(folder / "grasps", error);
       !error && it != fs::directory_iterator(); it.increment(error)) {
    std::error_code ignored;
    if (it->is_regular_file(ignored) && it->path().extension() == ".h5")
      files.push_back(it->path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

struct ObjectOfGrasps {
  std::string file;
  double scale = 0.0;
};

std::optional<ObjectOfGrasps> ReadObjectOf(const fs::path& grasps) {
  const std::unique_ptr<Hdf5Tree> tree = Hdf5Tree::Open(grasps);
  if (!tree) return std::nullopt;
  const auto file = tree->Text("/object/file");
  const auto scale = tree->Numbers("/object/scale");
  if (!file || !scale || scale->values.size() != 1) return std::nullopt;
  return ObjectOfGrasps{*file, scale->values[0]};
}

// Below the folder and nowhere else.
bool LeadsOut(const fs::path& file) {
  const fs::path plain = file.lexically_normal();
  return plain.is_absolute() || plain.empty() || *plain.begin() == "..";
}

}  // namespace

bool IsAcronymFolder(const fs::path& folder) {
  std::error_code ignored;
  return fs::is_directory(folder / "meshes", ignored) && !GraspFilesIn(folder).empty();
}

FoundMeshes FindAcronymMeshes(const fs::path& folder) {
  FoundMeshes found;
  found.layout = "ACRONYM";
  const std::vector<fs::path> files = GraspFilesIn(folder);
  // Texts of HDF5 have no check sums: a damaged file may kill who reads it (hdf5_tree.h).
  const bool sound = ReturnsInACopy(
      [&] {
        for (const fs::path& file : files) ReadObjectOf(file);
      },
      kMostSecondsOfAll);
  std::set<fs::path> named;
  for (const fs::path& file : files) {
    const auto skip = [&](const std::string& why) {
      found.skipped.emplace_back(file.string(), why);
    };
    if (!sound && !ReturnsInACopy([&] { ReadObjectOf(file); }, kMostSecondsOfOne)) {
      skip("damaged HDF5");
      continue;
    }
    const std::optional<ObjectOfGrasps> object = ReadObjectOf(file);
    std::error_code ignored;
    if (!object || !(object->scale > 0.0 && object->scale < 1e9)) {
      skip("no /object/file or /object/scale");
    } else if (LeadsOut(object->file) || !IsMeshFile(object->file)) {
      skip("/object/file is no mesh of this folder");
    } else if (const fs::path mesh = folder / object->file; !fs::is_regular_file(mesh, ignored)) {
      skip("its mesh is not there: " + object->file);
    } else {
      named.insert(mesh.lexically_normal());
      found.objects.push_back(
          {mesh.string(), {file.stem().string(), folder.string()}, object->scale});
    }
  }
  for (const fs::path& mesh : MeshFilesIn(folder)) {
    if (named.contains(mesh.lexically_normal())) continue;
    found.skipped.emplace_back(mesh.string(), "no file of grasps names it");
  }
  return found;
}

}  // namespace antigrasp
