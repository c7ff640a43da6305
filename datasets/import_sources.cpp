#include "antigrasp/datasets/import_sources.h"

#include <algorithm>
#include <set>
#include <system_error>

#include "antigrasp/core/error.h"
#include "antigrasp/datasets/mesh_folder.h"

namespace antigrasp {

namespace fs = std::filesystem;

namespace {

void AddFolder(const fs::path& folder, ImportSources* sources) {
  FoundMeshes found = FindMeshes(folder);
  if (!found.layout.empty()) {
    sources->layouts += folder.string() + ": layout of " + found.layout + ", " +
                        std::to_string(found.objects.size()) + " objects\n";
  }
  const bool plain = found.layout.empty() && !found.objects.empty();
  sources->meshes.insert(sources->meshes.end(), std::make_move_iterator(found.objects.begin()),
                         std::make_move_iterator(found.objects.end()));
  sources->skipped.insert(sources->skipped.end(), std::make_move_iterator(found.skipped.begin()),
                          std::make_move_iterator(found.skipped.end()));
  if (!plain) return;
  for (const fs::path& grids : GridFilesIn(folder)) {
    sources->skipped.emplace_back(grids.string(), "grids among meshes: import them by themselves");
  }
}

}  // namespace

ImportSources FindImportSources(const std::vector<fs::path>& inputs) {
  ImportSources sources;
  for (const fs::path& input : inputs) {
    std::error_code ignored;
    const fs::file_status status = fs::status(input, ignored);
    if (!fs::exists(status)) {
      throw InputError("no such file or folder", input.string(), "mesh files or folders of them");
    }
    if (fs::is_directory(status)) {
      AddFolder(input, &sources);
    } else {
      const std::string folder = fs::absolute(input).parent_path().string();
      sources.meshes.push_back({input.string(), {input.filename().string(), folder}, 1.0});
    }
  }
  std::stable_sort(sources.meshes.begin(), sources.meshes.end(),
                   [](const FoundMesh& a, const FoundMesh& b) {
                     return fs::path(a.path) < fs::path(b.path);  // part by part
                   });
  std::set<std::pair<std::string, double>> seen;
  std::erase_if(sources.meshes, [&](const FoundMesh& mesh) {
    std::error_code error;
    const fs::path real = fs::canonical(mesh.path, error);
    return !seen.insert({error ? mesh.path : real.string(), mesh.scale}).second;
  });
  std::sort(sources.skipped.begin(), sources.skipped.end());
  return sources;
}

std::vector<std::string> ImportNames(const std::vector<FoundMesh>& meshes, const fs::path& out) {
  std::vector<ObjectOrigin> origins;
  for (const FoundMesh& mesh : meshes) {
    std::error_code ignored;
    if (fs::equivalent(mesh.path, out, ignored)) {
      throw InputError("would be written over a mesh to import", out.string(), "another --out");
    }
    origins.push_back(mesh.origin);
  }
  return DistinctNames(origins);
}

}  // namespace antigrasp
