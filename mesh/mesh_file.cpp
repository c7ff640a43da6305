#include "antigrasp/mesh/mesh_file.h"

#include <algorithm>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/check.h"
#include "antigrasp/core/error.h"
#include "antigrasp/mesh/mesh_format.h"
#include "antigrasp/mesh/mesh_readers.h"

namespace antigrasp {
namespace {

constexpr const char* kExpected = "a mesh file: .stl, .obj, .ply or .off";
// Larger files overflow the 32-bit indices of TriangleMesh.
constexpr std::uintmax_t kLargestFile = std::uintmax_t{2} << 30;

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

std::optional<MeshFormat> FindMeshFormat(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  if (extension == ".stl") return MeshFormat::kStl;
  if (extension == ".obj") return MeshFormat::kObj;
  if (extension == ".ply") return MeshFormat::kPly;
  if (extension == ".off") return MeshFormat::kOff;
  return std::nullopt;
}

MeshFormat RequireMeshFormat(const std::filesystem::path& path) {
  const auto format = FindMeshFormat(path);
  if (!format) {
    throw InputError("extension '" + path.extension().string() + "'", path.string(), kExpected);
  }
  return *format;
}

bool IsMeshFile(const std::filesystem::path& path) { return FindMeshFormat(path).has_value(); }

TriangleMesh ReadMesh(const std::filesystem::path& path) {
  RequireFile(path, kExpected);
  const MeshFormat format = RequireMeshFormat(path);
  std::error_code ignored;
  if (std::filesystem::file_size(path, ignored) > kLargestFile) {
    throw InputError("file larger than 2 GiB", path.string(), "a smaller mesh");
  }
  const std::string bytes = ReadFile(path);
  if (bytes.empty()) throw InputError("empty file", path.string(), kExpected);
  return ToTriangleMesh(ReadSoup(format, bytes, path.string()), path.string());
}

}  // namespace antigrasp
