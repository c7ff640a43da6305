#include "antigrasp/mesh/mesh_file.h"

#include <algorithm>
#include <span>

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

TriangleMesh ReadByExtension(const std::filesystem::path& path, std::vector<std::string>* notes) {
  const MeshFormat format = RequireReadableFormat(path);
  std::error_code ignored;
  if (std::filesystem::file_size(path, ignored) > kLargestFile) {
    throw InputError("file larger than 2 GiB", path.string(), "a smaller mesh");
  }
  const std::string bytes = ReadFile(path);
  if (bytes.empty()) throw InputError("empty file", path.string(), Expected(kReadableFormats));
  return ToTriangleMesh(ReadSoup(format, bytes, path.string()), path.string(), notes);
}

}  // namespace

TriangleMesh ReadMesh(const std::filesystem::path& path, std::vector<std::string>* notes) {
  RequireFile(path, Expected(kReadableFormats));
  try {
    return ReadByExtension(path, notes);
  } catch (const InputError&) {
    RefuseOtherKind(path, FileKind::kMesh, "a mesh", Expected(kReadableFormats));
    throw;
  }
}

}  // namespace antigrasp
