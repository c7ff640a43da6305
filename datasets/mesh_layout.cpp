#include "antigrasp/datasets/mesh_layout.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <string_view>

#include "antigrasp/datasets/acronym_folder.h"
#include "antigrasp/datasets/mesh_folder.h"

namespace antigrasp {
namespace {

namespace fs = std::filesystem;
using Parts = std::vector<std::string>;  // of a path below the folder

// Whose object's folder a mesh lies in, and how willingly it is taken for it.
struct Place {
  std::size_t folder;  // the first parts of the path
  std::size_t rank;    // 0 is taken first; kNever
};
constexpr std::size_t kNever = 1000;

struct KnownLayout {
  std::string_view name;
  std::optional<Place> (*place_of)(const Parts& parts);
  std::size_t named_by;  // last parts of the object's folder
  std::string_view wanted;
};

std::optional<Place> InShapeNet(const Parts& parts) {
  if (parts.size() < 2 || parts[parts.size() - 2] != "models") return std::nullopt;
  if (parts.back() != "model_normalized.obj") return std::nullopt;
  return Place{parts.size() - 2, 0};
}

std::optional<Place> InScannedObjects(const Parts& parts) {
  if (parts.size() < 2 || parts[parts.size() - 2] != "meshes") return std::nullopt;
  if (parts.back() != "model.obj") return std::nullopt;
  return Place{parts.size() - 2, 0};
}

std::optional<Place> InYcb(const Parts& parts) {
  constexpr std::array<std::string_view, 6> kFolders = {"google_16k", "google_64k", "google_512k",
                                                        "poisson",    "tsdf",       "clouds"};
  constexpr std::array<std::string_view, 3> kFiles = {"nontextured.ply", "nontextured.stl",
                                                      "textured.obj"};
  if (parts.size() < 2) return std::nullopt;
  const auto folder = std::find(kFolders.begin(), kFolders.end(), parts[parts.size() - 2]);
  if (folder == kFolders.end()) return std::nullopt;
  const auto file = std::find(kFiles.begin(), kFiles.end(), parts.back());
  const bool mesh = file != kFiles.end() && *folder != "clouds";
  const auto rank =
      static_cast<std::size_t>((folder - kFolders.begin()) * 3 + (file - kFiles.begin()));
  return Place{parts.size() - 2, mesh ? rank : kNever};
}

constexpr std::array<KnownLayout, 3> kLayouts = {
    KnownLayout{"ShapeNet", InShapeNet, 2, "models/model_normalized.obj"},
    KnownLayout{"Google Scanned Objects", InScannedObjects, 1, "meshes/model.obj"},
    KnownLayout{"YCB", InYcb, 1, "google_16k/nontextured.ply or another mesh of YCB"}};

Parts PartsOf(const fs::path& file, const fs::path& folder) {
  // Absolute, so that the folder may be an object's own.
  Parts parts;
  for (const fs::path& part : fs::absolute(file).lexically_normal().relative_path()) {
    parts.push_back(part.string());
  }
  const fs::path above = fs::absolute(folder).lexically_normal().relative_path();
  std::size_t skip = static_cast<std::size_t>(std::count_if(
      above.begin(), above.end(), [](const fs::path& part) { return !part.empty(); }));
  skip -= std::min<std::size_t>(skip, 2);  // two folders above may name the object
  parts.erase(parts.begin(), parts.begin() + static_cast<std::ptrdiff_t>(skip));
  return parts;
}

// None of a file that lies in the folder itself.
std::optional<Place> PlaceIn(const KnownLayout& layout, const fs::path& file,
                             const fs::path& folder, const Parts& parts) {
  if (!file.lexically_relative(folder).has_parent_path()) return std::nullopt;
  return layout.place_of(parts);
}

ObjectOrigin OriginOf(const Parts& parts, std::size_t folder, std::size_t named_by,
                      const fs::path& file) {
  std::string name;
  for (std::size_t i = folder - std::min(folder, named_by); i < folder; ++i) {
    name += (name.empty() ? "" : "/") + parts[i];
  }
  fs::path above = fs::absolute(file).lexically_normal();
  for (std::size_t i = folder - std::min(folder, named_by); i < parts.size(); ++i) {
    above = above.parent_path();
  }
  return {name, above.string()};
}

FoundMeshes InLayout(const KnownLayout& layout, const std::vector<fs::path>& files,
                     const fs::path& folder) {
  FoundMeshes found;
  found.layout = layout.name;
  struct Best {
    std::size_t rank = kNever, file = 0;
  };
  std::map<std::string, Best> best;  // by the object's folder
  const auto key = [](const Parts& parts, const Place& place) {
    std::string text;
    for (std::size_t i = 0; i < place.folder; ++i) text += parts[i] + "/";
    return text;
  };
  for (std::size_t i = 0; i < files.size(); ++i) {
    const Parts parts = PartsOf(files[i], folder);
    const auto place = PlaceIn(layout, files[i], folder, parts);
    if (!place) continue;
    Best& taken = best[key(parts, *place)];
    if (place->rank < taken.rank) taken = {place->rank, i};
  }
  for (std::size_t i = 0; i < files.size(); ++i) {
    const Parts parts = PartsOf(files[i], folder);
    const auto place = PlaceIn(layout, files[i], folder, parts);
    if (!place) {
      found.skipped.emplace_back(files[i].string(), "in no object's folder of this layout");
      continue;
    }
    const Best& taken = best[key(parts, *place)];
    if (taken.rank == kNever) {
      found.skipped.emplace_back(files[i].string(), "no " + std::string(layout.wanted));
    } else if (taken.file != i) {
      found.skipped.emplace_back(
          files[i].string(),
          "of the same object as " + files[taken.file].lexically_relative(folder).string());
    } else {
      found.objects.push_back(
          {files[i].string(), OriginOf(parts, place->folder, layout.named_by, files[i]), 1.0});
    }
  }
  return found;
}

bool HasLayout(const KnownLayout& layout, const std::vector<fs::path>& files,
               const fs::path& folder) {
  std::size_t inside = 0, taken = 0;
  for (const fs::path& file : files) {
    const auto place = PlaceIn(layout, file, folder, PartsOf(file, folder));
    if (place) ++inside;
    if (place && place->rank != kNever) ++taken;
  }
  return taken > 0 && 2 * inside > files.size();
}

}  // namespace

FoundMeshes FindMeshes(const fs::path& folder) {
  if (IsAcronymFolder(folder)) return FindAcronymMeshes(folder);
  const std::vector<fs::path> files = MeshFilesIn(folder);
  for (const KnownLayout& layout : kLayouts) {
    if (HasLayout(layout, files, folder)) return InLayout(layout, files, folder);
  }
  FoundMeshes found;
  for (const fs::path& file : files) {
    found.objects.push_back(
        {file.string(), {file.lexically_relative(folder).generic_string(), folder.string()}, 1.0});
  }
  return found;
}

}  // namespace antigrasp
