#include "antigrasp/mesh/mesh_file.h"

#include <algorithm>
#include <span>
#include <utility>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/check.h"
#include "antigrasp/core/error.h"
#include "antigrasp/core/file_kind.h"
#include "antigrasp/mesh/mesh_format.h"
#include "antigrasp/mesh/mesh_readers.h"

namespace antigrasp {
namespace {

// Larger files overflow the 32-bit indices of TriangleMesh.
constexpr std::uintmax_t kLargestFile = std::uintmax_t{2} << 30;

std::vector<std::string> NamesOf(std::span<const MeshFormat> formats) {
  std::vector<std::string> names;
  for (const MeshFormat format : formats) names.push_back(ChoiceName(format));
  return names;
}

std::string Expected(std::span<const MeshFormat> formats) {
  return "a mesh file: " + Alternatives(NamesOf(formats), ".");
}

std::optional<MeshFormat> Find(const std::filesystem::path& path,
                               std::span<const MeshFormat> formats) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  for (const MeshFormat format : formats) {
    if (extension == "." + ChoiceName(format)) return format;
  }
  return std::nullopt;
}

MeshFormat Require(const std::filesystem::path& path, std::span<const MeshFormat> formats) {
  const auto format = Find(path, formats);
  if (!format) {
    throw InputError("extension '" + path.extension().string() + "'", path.string(),
                     Expected(formats));
  }
  return *format;
}

PolygonSoup ReadSoup(MeshFormat format, const std::string& bytes, const std::string& path) {
  switch (format) {
    case MeshFormat::kStl:
      return ReadStl(bytes, path);
    case MeshFormat::kObj:
      return ReadObj(bytes, path);
    case MeshFormat::kPly:
      return ReadPly(bytes, path);
    case MeshFormat::kOff:
      return ReadOff(bytes, path);
    case MeshFormat::k3mf:
      return Read3mf(bytes, path);
    case MeshFormat::kGlb:
      return ReadGlb(bytes, path);
    case MeshFormat::kDae:
      return ReadDae(bytes, path);
  }
  AG_CHECK(false, "unknown mesh format");
}

}  // namespace

std::vector<std::string> ReadableExtensions() { return NamesOf(kReadableFormats); }
std::vector<std::string> WritableExtensions() { return NamesOf(kWritableFormats); }

std::optional<MeshFormat> FindReadableFormat(const std::filesystem::path& path) {
  return Find(path, kReadableFormats);
}

MeshFormat RequireReadableFormat(const std::filesystem::path& path) {
  return Require(path, kReadableFormats);
}

MeshFormat RequireWritableFormat(const std::filesystem::path& path) {
  return Require(path, kWritableFormats);
}

bool IsMeshFile(const std::filesystem::path& path) { return FindReadableFormat(path).has_value(); }

std::filesystem::path FindMeshFile(const std::filesystem::path& folder, const std::string& name) {
  for (const std::string& extension : WritableExtensions()) {
    const std::filesystem::path path = folder / (name + "." + extension);
    if (std::filesystem::exists(path)) return path;
  }
  return folder / (name + ".stl");
}

namespace {

MeshFile ReadByExtension(const std::filesystem::path& path, MeshFormat format) {
  std::error_code ignored;
  if (std::filesystem::file_size(path, ignored) > kLargestFile) {
    throw InputError("file larger than 2 GiB", path.string(), "a smaller mesh");
  }
  const std::string bytes = ReadFile(path);
  if (bytes.empty()) throw InputError("empty file", path.string(), Expected(kReadableFormats));
  const PolygonSoup soup = ReadSoup(format, bytes, path.string());
  MeshFile file;
  file.mesh = ToTriangleMesh(soup, path.string(), &file.notes);
  file.unit = soup.unit;
  return file;
}

}  // namespace

MeshFile ReadMeshFile(const std::filesystem::path& path) {
  RequireFile(path, Expected(kReadableFormats));
  bool zipped = false;
  try {
    const MeshFormat format = RequireReadableFormat(path);
    zipped = format == MeshFormat::k3mf;
    return ReadByExtension(path, format);
  } catch (const InputError&) {
    RefuseOtherKind(path, zipped ? FileKind::kZip : FileKind::kMesh,
                    zipped ? "a 3MF file" : "a mesh", Expected(kReadableFormats));
    throw;
  }
}

TriangleMesh InUnit(MeshFile file, LengthUnit unit) {
  if (!file.unit || file.unit->metres == MetresPer(unit)) return std::move(file.mesh);
  return Transformed(file.mesh, file.unit->metres / MetresPer(unit), Eigen::Vector3d::Zero());
}

TriangleMesh ReadMesh(const std::filesystem::path& path, std::vector<std::string>* notes) {
  MeshFile file = ReadMeshFile(path);
  if (notes != nullptr) *notes = std::move(file.notes);
  return std::move(file.mesh);
}

}  // namespace antigrasp
