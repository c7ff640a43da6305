#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <string>
#include <vector>

#include "antigrasp/core/atomic_file.h"
#include "antigrasp/core/check.h"
#include "antigrasp/core/format.h"
#include "antigrasp/mesh/mesh_file.h"
#include "antigrasp/mesh/mesh_format.h"

namespace antigrasp {
namespace {

static_assert(std::endian::native == std::endian::little, "binary files are little endian");

// Must not begin with "solid": readers would take the file for ASCII.
constexpr std::string_view kStlHeader = "binary STL written by antigrasp";
constexpr std::size_t kStlHeaderBytes = 80;

template <typename T>
void Append(std::string* bytes, T value) {
  bytes->append(reinterpret_cast<const char*>(&value), sizeof(value));
}

void AppendStlVector(std::string* bytes, const Eigen::Vector3f& v) {
  for (int k = 0; k < 3; ++k) Append(bytes, v[k] + 0.0f);  // + 0 turns -0 into 0
}

std::string StlBytes(const TriangleMesh& mesh) {
  std::string bytes(kStlHeader);
  bytes.resize(kStlHeaderBytes, '\0');
  Append(&bytes, static_cast<std::uint32_t>(mesh.faces.size()));
  // Rounded in a loop of its own: GCC 12 at -O3 leaves out double -> float -> double within one.
  std::vector<Eigen::Vector3f> stored;
  for (const Eigen::Vector3d& v : mesh.vertices) stored.push_back(v.cast<float>());
  for (const auto& face : mesh.faces) {
    // The normal of what is stored, not of what was rounded to it.
    const Eigen::Vector3d a = stored[face[0]].cast<double>();
    const Eigen::Vector3d cross =
        (stored[face[1]].cast<double>() - a).cross(stored[face[2]].cast<double>() - a);
    const double length = cross.norm();
    const Eigen::Vector3d normal =
        length > 0.0 ? Eigen::Vector3d(cross / length) : Eigen::Vector3d(Eigen::Vector3d::Zero());
    AppendStlVector(&bytes, normal.cast<float>());
    for (const std::int32_t corner : face) AppendStlVector(&bytes, stored[corner]);
    Append(&bytes, std::uint16_t{0});
  }
  return bytes;
}

std::string PlyBytes(const TriangleMesh& mesh) {
  std::string bytes =
      "ply\nformat binary_little_endian 1.0\ncomment written by antigrasp\nelement vertex " +
      std::to_string(mesh.vertices.size()) +
      "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
      std::to_string(mesh.faces.size()) + "\nproperty list uchar int vertex_indices\nend_header\n";
  for (const auto& v : mesh.vertices) {
    for (int k = 0; k < 3; ++k) Append(&bytes, v[k]);
  }
  for (const auto& face : mesh.faces) {
    Append(&bytes, std::uint8_t{3});
    for (const std::int32_t corner : face) Append(&bytes, corner);
  }
  return bytes;
}

std::string PositionText(const Eigen::Vector3d& v) {
  return FormatDouble(v.x()) + " " + FormatDouble(v.y()) + " " + FormatDouble(v.z()) + "\n";
}

std::string FaceText(const std::array<std::int32_t, 3>& face, int first_index) {
  return " " + std::to_string(face[0] + first_index) + " " + std::to_string(face[1] + first_index) +
         " " + std::to_string(face[2] + first_index) + "\n";
}

std::string ObjBytes(const TriangleMesh& mesh) {
  std::string bytes = "# written by antigrasp\n";
  for (const auto& v : mesh.vertices) bytes += "v " + PositionText(v);
  for (const auto& face : mesh.faces) bytes += "f" + FaceText(face, 1);
  return bytes;
}

std::string OffBytes(const TriangleMesh& mesh) {
  std::string bytes = "OFF\n" + std::to_string(mesh.vertices.size()) + " " +
                      std::to_string(mesh.faces.size()) + " 0\n";
  for (const auto& v : mesh.vertices) bytes += PositionText(v);
  for (const auto& face : mesh.faces) bytes += "3" + FaceText(face, 0);
  return bytes;
}

std::string Bytes(MeshFormat format, const TriangleMesh& mesh) {
  switch (format) {
    case MeshFormat::kStl:
      return StlBytes(mesh);
    case MeshFormat::kObj:
      return ObjBytes(mesh);
    case MeshFormat::kPly:
      return PlyBytes(mesh);
    case MeshFormat::kOff:
      return OffBytes(mesh);
    case MeshFormat::k3mf:
    case MeshFormat::kGlb:
    case MeshFormat::kDae:
      break;  // are read only
  }
  AG_CHECK(false, "unknown mesh format");
}

}  // namespace

void WriteMesh(const std::filesystem::path& path, const TriangleMesh& mesh, double scale) {
  const MeshFormat format = RequireWritableFormat(path);
  const TriangleMesh scaled = Transformed(mesh, scale, Eigen::Vector3d::Zero());
  const auto count = static_cast<std::int64_t>(mesh.vertices.size());
  for (const auto& v : scaled.vertices) AG_CHECK(v.allFinite(), "mesh to write is not finite");
  for (const auto& face : mesh.faces) {
    for (const std::int32_t corner : face) {
      AG_CHECK(corner >= 0 && corner < count, "face of the mesh to write refers to no vertex");
    }
  }
  WriteFileAtomic(path, Bytes(format, scaled));
}

}  // namespace antigrasp
